#include "apps/common/output_place.h"

#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <system_error>

#include "apps/common/atomic_file.h"

namespace presa {

std::string placeTrouble(const std::string& file) {
  if (isStream(file)) return ::access(file.c_str(), W_OK) == 0 ? "" : std::generic_category().message(errno);
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
