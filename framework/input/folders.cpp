#include "framework/input/folders.h"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <system_error>

namespace presa::input {
namespace {

namespace fs = std::filesystem;

constexpr const char* kVariable = "PRESA_ALLOW_FOLDERS";

/// Absolute path with symbolic links resolved as far as the path exists; "" on failure (a loop of links).
fs::path real(const fs::path& path) {
  std::error_code error;
  const fs::path absolute = fs::absolute(path.empty() ? fs::path(".") : path, error);
  if (error) return {};
  fs::path found = fs::weakly_canonical(absolute, error);
  return error ? fs::path() : found.lexically_normal();
}

bool liesIn(const fs::path& file, const fs::path& folder) {
  if (folder.empty() || file.empty()) return false;
  const auto [end, rest] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
  return end == folder.end() || (end->empty() && std::next(end) == folder.end());  // the last component of "a/" is ""
}

/// Of the library with this function: also a program of somebody else, such as Python, may have loaded it.
fs::path libraryFolder() {
  Dl_info info{};
  const bool known = dladdr(reinterpret_cast<void*>(&allowFolder), &info) != 0 && info.dli_fname != nullptr;
  return known ? real(info.dli_fname).parent_path() : fs::path();
}

/// config and experiments above the library, as in the source tree, or below share/presa, where they are installed.
std::vector<fs::path> ownFolders() {
  std::error_code error;
  fs::path up = libraryFolder();
  for (int level = 0; level < 5 && up.has_relative_path(); ++level, up = up.parent_path()) {
    for (const fs::path& root : {up, up / "share/presa"}) {
      if (fs::is_directory(root / "config/schema", error) && fs::is_directory(root / "experiments", error))
        return {real(root / "config"), real(root / "experiments")};
    }
  }
  return {};
}

const std::vector<fs::path>& own() {
  static const std::vector<fs::path> folders = ownFolders();
  return folders;
}

std::vector<fs::path> allowed() {
  std::vector<fs::path> folders = own();
  const char* const named = std::getenv(kVariable);
  std::string list = named != nullptr ? named : "";
  for (std::size_t at = 0; at < list.size();) {
    const std::size_t end = std::min(list.find(':', at), list.size());
    if (end > at) folders.push_back(real(list.substr(at, end - at)));
    at = end + 1;
  }
  return folders;
}

}  // namespace

const char* const kOutsideHelp =
    "a file names files in its own folder, in that of a file on the command line, in Presa's config and experiments, "
    "or in a folder given with --allow-folder FOLDER";

std::string ownFolder(const std::string& name) {
  const auto found = std::ranges::find_if(own(), [&](const fs::path& folder) { return folder.filename() == name; });
  return found == own().end() ? std::string() : found->string();
}

void allowFolder(const std::string& folder) {
  const std::string wanted = real(folder).string();
  if (wanted.empty() || wanted.find(':') != std::string::npos) return;
  const char* const named = std::getenv(kVariable);
  std::string list = named != nullptr ? named : "";
  const std::vector<fs::path> already = allowed();
  if (std::find(already.begin(), already.end(), fs::path(wanted)) != already.end()) return;
  if (!list.empty()) list += ':';
  list.append(wanted);
  ::setenv(kVariable, list.c_str(), 1);
}

void allowFoldersOf(int count, char** words) {
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    for (std::size_t at = 0; at != std::string::npos && at < word.size();) {
      const fs::path file = word.substr(at);
      std::error_code error;
      if (fs::is_regular_file(file, error)) allowFolder(file.parent_path().string());
      at = word.find('=', at);
      if (at != std::string::npos) ++at;
    }
  }
}

bool mayName(const std::string& folder, const std::string& file) {
  const fs::path found = real(file);
  if (liesIn(found, real(folder))) return true;
  const std::vector<fs::path> folders = allowed();
  return std::any_of(folders.begin(), folders.end(), [&](const fs::path& one) { return liesIn(found, one); });
}

std::string outside(const std::string& folder, const std::string& file) {
  const fs::path found = real(file);
  const std::string told =
      found.empty() || found == fs::path(file).lexically_normal() ? "" : " (" + found.string() + ")";
  return quote(file) + told + " lies outside the folder " + real(folder).string() + " of the file that names it";
}

bool checkNamed(const SourceLocation& where, const std::string& file, Diagnostics& diagnostics) {
  const std::string folder = fs::path(where.file).parent_path().string();
  if (mayName(folder, file)) return true;
  diagnostics.error(kOutside, where, outside(folder, file), kOutsideHelp);
  return false;
}

}  // namespace presa::input
