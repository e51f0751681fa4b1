#pragma once
#include <filesystem>
#include <string>

namespace presa::experiment {

/// A new folder that appears under its name only when it is whole. Until then it lies beside it, hidden; what a killed process
/// left there is removed by the next one that makes the same folder. Thread: main.
class StagedFolder {
 public:
  /// Throws InputError E933 when `target` exists or cannot be made.
  explicit StagedFolder(const std::string& target);
  ~StagedFolder();
  StagedFolder(const StagedFolder&) = delete;
  StagedFolder& operator=(const StagedFolder&) = delete;

  /// Writes a file; its folders are made. Throws std::system_error.
  void write(const std::string& name, const std::string& text) const;
  /// Gives it its name. Throws InputError E933 when somebody else has made `target` meanwhile.
  void publish();

 private:
  std::filesystem::path target_, hidden_;
  int lock_ = -1;
};

}  // namespace presa::experiment
