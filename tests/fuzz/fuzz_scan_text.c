// Scans that begin as text does: scan.h.
#include "tests/fuzz/scan.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  fuzz_scan(data, size, &(SbScanChoices){0});
  fuzz_scan(data, size, &(SbScanChoices){.unit = 1e-9, .spacing = 1e-6});
  return 0;
}
