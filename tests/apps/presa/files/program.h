#pragma once
#include <string>

#include "apps/common/scratch_folder.h"

namespace presa::test {

inline const std::string kProgram = PRESA_BINARY_DIR "/bin/presa";
inline const std::string kSource = PRESA_SOURCE_DIR;

/// Result of a shell command. A command that hangs is ended after 60 s, with status 124.
struct Outcome {
  int status = -1;
  std::string text;  ///< standard output and standard error
};

/// A scratch folder in which files are created and the program is run.
class Bench {
 public:
  std::string file(const std::string& name) const { return scratch_.file(name); }
  void write(const std::string& name, const std::string& text) const;
  void fifo(const std::string& name) const;
  /// Runs a shell command in the folder.
  Outcome shell(const std::string& command) const;
  Outcome presa(const std::string& arguments) const { return shell("exec timeout 60 " + kProgram + " " + arguments); }
  /// scene.xml: one fixed body whose haptic mesh is `mesh`.
  void writeMeshScene(const std::string& mesh) const;
  /// rig.xml: thumb and index, both with this driver and setting.
  void writeRig(const std::string& driver, const std::string& key, const std::string& value) const;

 private:
  ScratchFolder scratch_;
};

}  // namespace presa::test
