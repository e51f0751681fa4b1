#include "tests/layering/source_tree.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <regex>
#include <set>
#include <stdexcept>
#include <string_view>

namespace presa::layering {
namespace {

namespace fs = std::filesystem;
const fs::path kRoot = PRESA_SOURCE_DIR;

bool isLocal(const std::string& name) {  // local to a checkout, as in .gitignore
  static const std::set<std::string> kNames{".git",    "build", "out", ".cache", "compile_commands.json",
                                            ".vscode", ".idea"};
  return kNames.contains(name) || name.starts_with("build-") || name.ends_with(".swp");
}

std::string contents(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<SourceFile> readTree() {
  std::vector<SourceFile> files;
  for (const std::string& entry : rootEntries()) {
    const fs::path top = kRoot / entry;
    if (fs::is_regular_file(top)) files.push_back({entry, contents(top)});
    if (!fs::is_directory(top)) continue;
    for (const auto& found : fs::recursive_directory_iterator(top)) {
      if (!found.is_regular_file() || isLocal(found.path().filename())) continue;
      files.push_back({fs::relative(found.path(), kRoot).generic_string(), contents(found.path())});
    }
  }
  std::sort(files.begin(), files.end(), [](const SourceFile& a, const SourceFile& b) { return a.path < b.path; });
  return files;
}

}  // namespace

std::string SourceFile::topFolder() const { return path.substr(0, path.find('/')); }

std::string SourceFile::part() const {
  const std::size_t first = path.find('/');
  return first == std::string::npos ? path : path.substr(0, path.find('/', first + 1));
}

bool SourceFile::isCpp() const { return path.ends_with(".h") || path.ends_with(".cpp"); }

bool SourceFile::isText() const {
  static const std::set<std::string> kSuffixes{".h", ".cpp", ".cmake", ".txt", ".md", ".xml", ".xsd", ".json", ""};
  return kSuffixes.contains(fs::path(path).extension().string());
}

std::size_t SourceFile::lines() const {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) +
         (text.empty() || text.ends_with('\n') ? 0U : 1U);
}

std::vector<std::string> SourceFile::includes() const {
  static const std::regex kInclude(R"re((?:^|\n)[ \t]*#[ \t]*include[ \t]*[<"]([^>"\n]+)[>"])re");
  std::vector<std::string> names;
  for (std::sregex_iterator match(text.begin(), text.end(), kInclude), end; match != end; ++match) {
    names.push_back((*match)[1]);
  }
  return names;
}

const std::vector<SourceFile>& sourceTree() {
  static const std::vector<SourceFile> kFiles = readTree();
  return kFiles;
}

std::vector<std::string> rootEntries() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(kRoot)) {
    const std::string name = entry.path().filename();
    if (!isLocal(name)) names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::string> rooms() {
  std::set<std::string> names;
  for (const SourceFile& file : sourceTree()) {
    if (file.path.starts_with('.') || file.path.find('/') == std::string::npos) continue;
    names.insert(file.topFolder());
    if (file.topFolder() != "tests" && file.topFolder() != "config" && file.part() != file.path)
      names.insert(file.part());
  }
  return {names.begin(), names.end()};
}

namespace {

std::string outputOf(const std::string& command) {
  const auto close = [](FILE* pipe) { pclose(pipe); };
  const std::unique_ptr<FILE, decltype(close)> pipe(popen(command.c_str(), "r"), close);
  std::string output;
  std::array<char, 4096> block{};
  while (pipe != nullptr) {
    const std::size_t size = std::fread(block.data(), 1, block.size(), pipe.get());
    if (size == 0) break;
    output.append(block.data(), size);
  }
  return output;
}

std::set<std::string> firstGroups(const std::string& text, const std::regex& pattern) {
  std::set<std::string> found;
  for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match)
    found.insert((*match)[1]);
  return found;
}

}  // namespace

std::set<std::string> neededLibraries(const std::string& file) {
  if (!fs::exists(file)) throw std::runtime_error(file + " was not built");
  static const std::regex kNeeded(R"(\(NEEDED\)[^\[]*\[([^\]]+)\])");
  auto names = firstGroups(outputOf("LC_ALL=C readelf -d '" + file + "'"), kNeeded);
  if (names.empty()) throw std::runtime_error("readelf named no library for " + file);  // libc is always linked
  return names;
}

std::set<std::string> nameSpaces(const std::string& file) {
  if (!fs::exists(file)) throw std::runtime_error(file + " was not built");
  static const std::regex kSpace(R"([Tt] presa::([a-z_]+)::)");  // defined functions
  return firstGroups(outputOf("LC_ALL=C nm -C '" + file + "'"), kSpace);
}

}  // namespace presa::layering
