#include "tests/fuzz/targets.h"

/// The entry of a libFuzzer program, compiled once for each target.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  presa::fuzz::PRESA_FUZZ_TARGET(data, size);
  return 0;
}
