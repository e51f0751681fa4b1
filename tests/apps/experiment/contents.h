#pragma once
#include <filesystem>
#include <map>
#include <string>

#include "apps/common/file_text.h"

namespace presa::experiment {

/// Every file below a folder.
inline std::map<std::string, std::string> allBytesOf(const std::string& folder) {
  std::map<std::string, std::string> all;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) all[entry.path().string()] = contentsOf(entry.path().string());
  }
  return all;
}

}  // namespace presa::experiment
