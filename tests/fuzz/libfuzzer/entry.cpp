#include <cstdio>
#include <cstdlib>

#include "tests/fuzz/targets.h"

/// The entry of a libFuzzer program, compiled once for each target.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string violated = presa::fuzz::PRESA_FUZZ_TARGET(data, size);
  if (violated.empty()) return 0;
  std::fprintf(stderr, "%s\n", violated.c_str());
  std::abort();
}
