#include "apps/common/output_place.h"

#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <system_error>

namespace presa {

std::string placeTrouble(const std::string& file) {
  const std::filesystem::path folder = std::filesystem::path(file).parent_path();
  std::error_code error;
  if (!folder.empty()) std::filesystem::create_directories(folder, error);
  if (!error && std::filesystem::is_directory(file)) error = std::make_error_code(std::errc::is_a_directory);
  if (!error) {
    std::string probe = ((folder.empty() ? "." : folder) / ".presa-place-XXXXXX").string();
    const int made = mkstemp(probe.data());
    if (made < 0) error = {errno, std::generic_category()};
    if (made >= 0) ::close(made), ::unlink(probe.c_str());
  }
  return error ? error.message() : "";
}

}  // namespace presa
