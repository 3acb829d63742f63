// Scans that begin as Gwyddion's do: scan.h.
#include "tests/fuzz/scan.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  fuzz_scan(data, size, &(SbScanChoices){0});
  return 0;
}
