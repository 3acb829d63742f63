// The check sum of a PNG chunk's name and data, bit by bit.
#pragma once

#include <stddef.h>
#include <stdint.h>

static inline uint32_t crc(const uint8_t *data, size_t size) {
  uint32_t sum = 0xffffffffu;
  for (size_t i = 0; i < size; i++) {
    sum ^= data[i];
    for (int k = 0; k < 8; k++) {
      sum = sum >> 1 ^ (sum & 1 ? 0xedb88320u : 0);
    }
  }
  return ~sum;
}
