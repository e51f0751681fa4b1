#pragma once
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace presa::faults {

/// A temporary file that is deleted with this object.
class TemporaryFile {
 public:
  /// `ending`: file name extension with the dot.
  TemporaryFile(const std::string& contents, const std::string& ending) {
    path_ = (std::filesystem::temp_directory_path() / ("presa_fault_XXXXXX" + ending)).string();
    const int file = ::mkstemps(path_.data(), static_cast<int>(ending.size()));
    const auto size = static_cast<ssize_t>(contents.size());
    const bool written = file >= 0 && ::write(file, contents.data(), contents.size()) == size;
    if (file >= 0) ::close(file);
    if (!written) throw std::runtime_error("cannot write a file like " + path_);
  }
  ~TemporaryFile() { ::unlink(path_.c_str()); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace presa::faults
