#include <cstdlib>
#include <filesystem>
#include <string>

#include "tests/framework/record/mutation.h"
#include "tests/fuzz/targets.h"

namespace presa::fuzz {
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
  Files() { record::writeSpecimen(specimen, kTicks); }
  ~Files() { std::filesystem::remove_all(in); }
};

}  // namespace

std::string recording(const std::uint8_t* data, std::size_t size) {
  static const Files files;
  std::filesystem::copy_file(files.specimen, files.run, std::filesystem::copy_options::overwrite_existing);
  record::mutate(files.run, data, size);
  return record::judge(files.run, kTicks);
}

}  // namespace presa::fuzz
