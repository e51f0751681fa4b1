#pragma once
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace presa::test {

/// Names of the files of config/scenes, in the order of the alphabet.
inline std::vector<std::string> shippedScenes() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(PRESA_SOURCE_DIR "/config/scenes"))
    if (entry.path().extension() == ".xml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace presa::test
