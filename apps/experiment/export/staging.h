#pragma once
#include <filesystem>
#include <string>

namespace presa::experiment {

/// A new folder that gets its name only when it is complete. Until then it is a hidden folder beside the target. Hidden
/// folders of killed processes are removed when the same target is staged again. Thread: main.
class StagedFolder {
 public:
  /// Throws InputError E933 when `target` exists or cannot be made.
  explicit StagedFolder(const std::string& target);
  ~StagedFolder();
  StagedFolder(const StagedFolder&) = delete;
  StagedFolder& operator=(const StagedFolder&) = delete;

  /// Writes a file and creates its parent folders. Throws std::system_error.
  void write(const std::string& name, const std::string& text) const;
  /// Renames the hidden folder to `target`. Throws InputError E933 when `target` has been created meanwhile.
  void publish();

 private:
  std::filesystem::path target_, hidden_;
  int lock_ = -1;
};

}  // namespace presa::experiment
