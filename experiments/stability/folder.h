#pragma once
#include <unistd.h>

#include <filesystem>
#include <string>

#include "framework/input/folders.h"

namespace presa::stability {

/// A temporary folder for the meshes of one trial, deleted with this object. Scenes may name files in it.
class Folder {
 public:
  /// `name`: of the case; each trial is a process of its own, so the process makes it unique.
  explicit Folder(const std::string& name)
      : path_(std::filesystem::temp_directory_path() / ("presa_" + name + "_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_);
    input::allowFolder(path_.string());  // the scene, in a folder of its own, names the mesh
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

}  // namespace presa::stability
