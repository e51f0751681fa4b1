#pragma once
#include <array>
#include <limits>
#include <string>
#include <vector>

#include "framework/core/math/spatial.h"

namespace presa::falcon_model {

struct WatchLimits {
  double force = std::numeric_limits<double>::infinity();       ///< [N]
  double force_rate = std::numeric_limits<double>::infinity();  ///< [N/s]
  /// Added to the time between two requests: max difference between tick and request times on a real clock [s].
  double jitter = 0;
};

/// The information that the host had read when it wrote a request.
struct Knowledge {
  static constexpr std::size_t kPoses = 4;
  /// d(thighs)/d(position) at the last poses that the host read, newest first, then at the true pose: a host that
  /// rejects a sample continues with an older one.
  std::array<Mat3, kPoses + 1> rates{};
  std::size_t poses = 0;
  int homed_replies = 0;    ///< consecutive replies with all three encoders referenced
  bool lost_homed = false;  ///< the host was told of a lost reference after it had all three
  double lost_at = 0;       ///< [s]
};

/// The newest request that arrived.
struct Received {
  double time = -1;  ///< [s]; negative: none yet
  std::array<int, 3> counts{};
  Vec3 force_D = Vec3::Zero();  ///< force of these counts at the true pose [N]
  Vec3 meant_D =
      Vec3::Zero();  ///< at the pose the host last read: the commanded force, up to the rounding of counts [N]
  bool homing = false, green = false, blue = false, red = false;
};

/// Checks the requests to a Falcon, independently of the sender. Violations: a word of more than 4095 counts; a force
/// above the limit; a change of force between two received requests faster than the slew limit; a force before the host
/// had read ten consecutive replies with all references; after the host read that a reference was lost, a force that
/// does not go to zero at the slew limit, or returns.
/// Thread: the owner's.
class ForceWatch {
 public:
  void limits(const WatchLimits& limits) { limits_ = limits; }
  void see(const Received& request, const Knowledge& knowledge);
  /// Resets the comparison with earlier requests, after a power cycle.
  void forget() { last_ = {}, released_from_ = -1; }

  const std::vector<std::string>& violations() const { return violations_; }
  double largestStep() const { return largest_step_; }    ///< [N]
  double largestForce() const { return largest_force_; }  ///< [N]

  static constexpr int kMaxCounts = 4095;
  static constexpr int kHomedReplies = 10;

 private:
  void judge(bool broken, const char* what, const Received& request);
  void judgeStep(const Received& request, const Knowledge& knowledge);
  void judgeRelease(const Received& request, const Knowledge& knowledge, double min);

  WatchLimits limits_;
  Received last_;
  Knowledge last_knowledge_;
  double released_from_ = -1;  // force when the host learnt of the lost reference [N]; negative: none lost
  double largest_step_ = 0, largest_force_ = 0;
  std::vector<std::string> violations_;
};

/// Force on the grip by the motor words at the pose of `rates`, in D [N].
Vec3 forceOf(const std::array<int, 3>& counts, const Mat3& rates);
/// Max effect on that force of rounding each word [N].
double roundingOf(const Mat3& rates);

}  // namespace presa::falcon_model
