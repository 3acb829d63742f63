// What any bytes must survive as a PNG that may hold a scene: a text, or one complaint.
#include "app/base/unit.h"
#include "app/document/document.h"
#include "app/document/picture.h"
#include "app/export/still.h"
#include "tests/crc.h"

#include <stdint.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

// Every chunk gets the right check sum, or hardly a changed one would be looked at.
static void seal_chunks(uint8_t *data, size_t size) {
  size_t at = 8;
  while (at + 12 <= size) {
    size_t length = (size_t)data[at] << 24 | (size_t)data[at + 1] << 16 |
                    (size_t)data[at + 2] << 8 | data[at + 3];
    if (length > size - at - 12) {
      return;
    }
    uint32_t sum = crc(data + at + 4, length + 4);
    for (int k = 0; k < 4; k++) {
      data[at + 8 + length + (size_t)k] = (uint8_t)(sum >> (24 - 8 * k));
    }
    at += length + 12;
  }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  uint8_t *copy = g_memdup2(data, size);
  if (size > 0 && data[0] == 0x89) {
    seal_chunks(copy, size);
  }
  GError *error = NULL;
  char *scene = sb_picture_find_scene(copy, size, &error);
  g_free(copy);
  g_assert_true((scene == NULL) == (error != NULL));
  g_assert_true(error == NULL || error->domain == SB_APP_ERROR);
  if (scene != NULL) {
    // As a file of that text would be.
    GPtrArray *issues = sb_issues_new();
    SbDocument *document = sb_document_parse(scene, strlen(scene), "fuzz", NULL, issues);
    g_assert_true(document != NULL || issues->len > 0);
    sb_document_free(document);
    g_ptr_array_unref(issues);
  }
  g_clear_error(&error);
  g_free(scene);
  return 0;
}
