#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "framework/plugin/plugin_loader.h"
#include "framework/record/checksum/checksum.h"
#include "tests/framework/record/mutation.h"

extern "C" const presa::ChecksumPlugin presaChecksums;

namespace presa {
// replaces plug-in loading: the only plug-in that a recording needs is compiled in
void* pluginSymbol(const std::string&, const char*) { return const_cast<ChecksumPlugin*>(&presaChecksums); }
}  // namespace presa

namespace {

constexpr std::uint64_t kTicks = 40;

/// A folder in memory if the system has one: each input writes a megabyte.
std::string folder() {
  const std::string shared = "/dev/shm";
  const std::string base =
      std::filesystem::is_directory(shared) ? shared : std::filesystem::temp_directory_path().string();
  std::string name = base + "/presa_fuzz_XXXXXX";
  if (mkdtemp(name.data()) == nullptr) std::abort();
  return name;
}

struct Files {
  std::string in = folder(), specimen = in + "/specimen.h5", run = in + "/run.h5";
  Files() { presa::record::writeSpecimen(specimen, kTicks); }
  ~Files() { std::filesystem::remove_all(in); }
};

}  // namespace

/// Any input describes damage to a recording, which must then be refused or sound (tests/framework/record/mutation.h).
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Files files;
  std::filesystem::copy_file(files.specimen, files.run, std::filesystem::copy_options::overwrite_existing);
  presa::record::mutate(files.run, data, size);
  const std::string wrong = presa::record::judge(files.run, kTicks);
  if (wrong.empty()) return 0;
  std::fprintf(stderr, "%s\n", wrong.c_str());
  std::abort();
}
