#pragma once
#include <memory>
#include <string>
#include <vector>

namespace presa::test {

/// A scene with its rig, run in virtual time to the end of its devices' script:
///
///     const LockstepRun run(SCENE_DIR "/lift.xml");
///     EXPECT_GT(run.rise("cube"), 0.05);
class LockstepRun {
 public:
  /// Runs. `sets`: overrides as on the command line, PATH=VALUE. Throws InputError with every finding.
  explicit LockstepRun(const std::string& scene, const std::vector<std::string>& sets = {});
  ~LockstepRun();

  /// How far the body's origin was above its start, at most [m]. Throws std::out_of_range for an unknown body.
  double rise(const std::string& body) const;
  /// Largest normal force on the fingertip of that role [N]. Throws std::out_of_range for an unknown role.
  double maxNormalForce(const std::string& role) const;
  /// What must not happen, in sentences: an effect that broke its contract, a fault of the dynamics, a fingertip that
  /// went through a surface.
  const std::vector<std::string>& faults() const noexcept;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace presa::test
