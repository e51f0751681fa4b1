#include "apps/experiment/export/staging.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <system_error>

#include "framework/core/diagnostics/refuse.h"

namespace presa::experiment {
namespace {

namespace fs = std::filesystem;

int openLocked(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor >= 0 && ::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return descriptor;
  if (descriptor >= 0) ::close(descriptor);
  return -1;
}

/// Removes the hidden folders of killed exports: partial copies of personal data must not stay behind.
void removeLeftovers(const fs::path& parent, const std::string& prefix) {
  for (const auto& entry : fs::directory_iterator(parent)) {
    if (!entry.path().filename().string().starts_with(prefix) || entry.is_symlink()) continue;
    const int lock = openLocked(entry.path());
    if (lock < 0) continue;  // locked: its process is still running
    fs::remove_all(entry.path());
    ::close(lock);
  }
}

}  // namespace

StagedFolder::StagedFolder(const std::string& target) : target_(fs::absolute(target).lexically_normal()) {
  if (!target_.has_filename()) target_ = target_.parent_path();
  if (fs::exists(fs::symlink_status(target_))) refuse(933, target, "exists already: nothing is ever overwritten");
  const std::string prefix = ".presa-export-" + target_.filename().string() + ".";
  std::error_code error;
  fs::create_directories(target_.parent_path(), error);
  if (error) refuse(933, target, "cannot be made: " + error.message());
  removeLeftovers(target_.parent_path(), prefix);
  std::string pattern = (target_.parent_path() / (prefix + "XXXXXX")).string();
  if (::mkdtemp(pattern.data()) == nullptr) refuse(933, target, std::string("cannot be made: ") + std::strerror(errno));
  hidden_ = pattern;
  lock_ = openLocked(hidden_);
}

StagedFolder::~StagedFolder() {
  if (!hidden_.empty()) {
    std::error_code ignored;
    fs::remove_all(hidden_, ignored);
  }
  if (lock_ >= 0) ::close(lock_);
}

void StagedFolder::write(const std::string& name, const std::string& text) const {
  const fs::path file = hidden_ / name;
  fs::create_directories(file.parent_path());
  std::ofstream out(file, std::ios::binary);
  out << text << std::flush;
  if (!out) throw std::system_error(errno, std::generic_category(), "cannot write " + (target_ / name).string());
}

void StagedFolder::publish() {
  const mode_t mask = ::umask(0);
  ::umask(mask);
  fs::permissions(hidden_, static_cast<fs::perms>(0777 & ~mask));  // mkdtemp creates the folder with mode 0700
  if (::renameat2(AT_FDCWD, hidden_.c_str(), AT_FDCWD, target_.c_str(), RENAME_NOREPLACE) != 0)
    refuse(933, target_.string(), std::string("cannot be made: ") + std::strerror(errno));
  hidden_.clear();
}

}  // namespace presa::experiment
