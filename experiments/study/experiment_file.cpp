#include "experiments/study/experiment_file.h"

#include <cstdlib>
#include <filesystem>
#include <vector>

#include "framework/core/diagnostics/refuse.h"
#include "framework/input/folders.h"

namespace presa {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> candidates() {
  std::vector<fs::path> folders;
  if (const char* named = std::getenv("PRESA_EXPERIMENTS")) folders.emplace_back(named);
  // of the source tree, or installed with the program
  if (const std::string own = input::ownFolder("experiments"); !own.empty()) folders.emplace_back(own);
  std::error_code ignored;
  folders.push_back(fs::current_path(ignored) / "experiments");
  return folders;
}

}  // namespace

std::string experimentFile(const std::string& name) {
  std::string tried;
  for (const fs::path& folder : candidates()) {
    const fs::path file = folder / name;
    if (fs::exists(file)) return file.lexically_normal().string();
    tried += (tried.empty() ? "" : ", ") + folder.string();
  }
  refuse(615, name, "file not found in the folder experiments",
         "looked in: " + tried + "; set PRESA_EXPERIMENTS to the folder experiments");
}

}  // namespace presa
