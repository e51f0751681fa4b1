#include "apps/common/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <system_error>

namespace presa {
namespace {

const std::string kHalfWritten = ".presa-";

[[noreturn]] void fail(int error, const std::string& path) {
  throw std::system_error(error, std::generic_category(), "cannot write " + path);
}

/// 0, or the errno of the first step that failed.
int writeAll(int file, const std::string& text) {
  for (std::size_t written = 0; written < text.size();) {
    const ssize_t step = ::write(file, text.data() + written, text.size() - written);
    if (step < 0 && errno == EINTR) continue;
    if (step < 0) return errno;
    written += static_cast<std::size_t>(step);
  }
  return 0;
}

void writeStream(const std::string& path, const std::string& text) {
  const int file = ::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (file < 0) fail(errno, path);
  int error = writeAll(file, text);
  if (::close(file) != 0 && error == 0) error = errno;
  if (error != 0) fail(error, path);
}

}  // namespace

bool isStream(const std::string& path) {
  std::error_code none;
  const auto status = std::filesystem::status(path, none);
  if (std::filesystem::is_regular_file(status)) {  // an open file of this process, as /dev/stdout may be
    const std::string link = std::filesystem::read_symlink(path, none).string();
    return path.starts_with("/dev/fd/") || link.starts_with("/proc/self/fd/");
  }
  return std::filesystem::exists(status) && !std::filesystem::is_directory(status);
}

void writeFileAtomically(const std::string& path, const std::string& text) {
  if (isStream(path)) return writeStream(path, text);
  const std::filesystem::path target(path);
  std::string temporary = (target.parent_path() / (kHalfWritten + target.filename().string() + ".XXXXXX")).string();
  const int file = ::mkstemp(temporary.data());
  if (file < 0) fail(errno, path);
  const mode_t mask = ::umask(0);
  ::umask(mask);
  int error = ::fchmod(file, 0666 & ~mask) == 0 ? 0 : errno;
  if (error == 0) error = writeAll(file, text);
  // before the rename, or a power cut could leave an empty file under the final name
  if (error == 0 && ::fsync(file) != 0) error = errno;
  if (::close(file) != 0 && error == 0) error = errno;
  if (error == 0 && std::rename(temporary.c_str(), path.c_str()) != 0) error = errno;
  if (error == 0) return;
  ::unlink(temporary.c_str());
  fail(error, path);
}

void removeHalfWritten(const std::string& folder) {
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().filename().string().starts_with(kHalfWritten)) std::filesystem::remove(entry.path());
  }
}

}  // namespace presa
