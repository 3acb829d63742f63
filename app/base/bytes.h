// Little-endian numbers in the bytes of a file, at any alignment. The caller checks that enough
// bytes are left.
#pragma once

#include <glib.h>
#include <stdbool.h>
#include <string.h>

// Returns whether the `length` bytes at `p` begin with the text `start`.
static inline bool sb_bytes_begin(const void *p, gsize length, const char *start) {
  return length >= strlen(start) && memcmp(p, start, strlen(start)) == 0;
}

// Returns the integer in the 2 bytes at `p`.
static inline guint16 sb_bytes_u16(const void *p) {
  guint16 value;
  memcpy(&value, p, sizeof value);
  return GUINT16_FROM_LE(value);
}

// Returns the integer in the 4 bytes at `p`.
static inline guint32 sb_bytes_u32(const void *p) {
  guint32 value;
  memcpy(&value, p, sizeof value);
  return GUINT32_FROM_LE(value);
}

// Returns the IEEE float in the 4 bytes at `p`.
static inline double sb_bytes_float(const void *p) {
  const guint32 bits = sb_bytes_u32(p);
  float value;
  memcpy(&value, &bits, sizeof value);
  return (double)value;
}

// Returns the IEEE double in the 8 bytes at `p`.
static inline double sb_bytes_double(const void *p) {
  guint64 bits;
  double value;
  memcpy(&bits, p, sizeof bits);
  bits = GUINT64_FROM_LE(bits);
  memcpy(&value, &bits, sizeof value);
  return value;
}
