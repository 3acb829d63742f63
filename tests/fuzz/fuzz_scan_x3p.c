// X3P: whole zips, and, in place of a zip, main.xml and its points behind a zero byte, which are
// packed here, or the check sums would keep every changed one out. See scan.h.
#include "tests/app/scan_files.h"
#include "tests/fuzz/scan.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  const uint8_t *end = size > 0 ? memchr(data, '\0', size) : NULL;
  if (size > 0 && data[0] == '<' && end != NULL) {
    GByteArray *members[] = {g_byte_array_new(), g_byte_array_new(), g_byte_array_new()};
    put_bytes(members[0], data, (gsize)(end - data));
    put_bytes(members[1], end + 1, size - (gsize)(end - data) - 1);
    put_bytes(members[2], data, (gsize)(end - data));
    GByteArray *zip = write_zip(
        (const char *const[]){"main.xml", "bindata/data.bin", "bindata/valid.bin"}, members, 3);
    fuzz_scan(zip->data, zip->len, &(SbScanChoices){0});
    g_byte_array_unref(zip);
    for (size_t i = 0; i < G_N_ELEMENTS(members); i++) {
      g_byte_array_unref(members[i]);
    }
  } else {
    fuzz_scan(data, size, &(SbScanChoices){0});
  }
  return 0;
}
