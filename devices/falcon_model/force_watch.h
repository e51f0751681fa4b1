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
  /// Added to the time between two requests: what may lie between a tick and its request on a clock that is not virtual [s].
  double jitter = 0;
};

/// What the host could know when it wrote a request: what it had read until then.
struct Knowledge {
  static constexpr std::size_t kPoses = 4;
  /// d(thighs)/d(position) where it last saw the grip, newest first, and then where it is: who does not believe what he sees
  /// may go on with where it was.
  std::array<Mat3, kPoses + 1> rates{};
  std::size_t poses = 0;
  int homed_replies = 0;    ///< in a row, all three encoders referenced
  bool lost_homed = false;  ///< it was told that a reference was lost, after it had all three
  double lost_at = 0;       ///< [s]
};

/// The newest request that arrived.
struct Received {
  double time = -1;  ///< [s]; negative: none yet
  std::array<int, 3> counts{};
  Vec3 force_D = Vec3::Zero();  ///< of these counts where the grip was [N]
  Vec3 meant_D =
      Vec3::Zero();  ///< where the host last saw it: what was commanded, to within the rounding of counts [N]
  bool homing = false, green = false, blue = false, red = false;
};

/// Judges what a Falcon is told, knowing nothing of who tells it:
///   a word of more than 4095 counts; a force above the limit; a force that changes faster, from one request that arrived to the
///   next, than the slew limit over the time between them; a force before the host had read ten replies in a row with all references;
///   and after it read that one was lost, a force that does not go to zero as fast as the slew limit lets it, or comes back.
/// Thread: the owner's.
class ForceWatch {
 public:
  void limits(const WatchLimits& limits) { limits_ = limits; }
  void see(const Received& request, const Knowledge& knowledge);
  /// Another life of the device: what comes now is compared with nothing before.
  void forget() { last_ = {}, released_from_ = -1; }

  const std::vector<std::string>& violations() const { return violations_; }
  double largestStep() const { return largest_step_; }    ///< [N]
  double largestForce() const { return largest_force_; }  ///< [N]

  static constexpr int kMostCounts = 4095;
  static constexpr int kHomedReplies = 10;

 private:
  void judge(bool broken, const char* what, const Received& request);
  void judgeStep(const Received& request, const Knowledge& knowledge);
  void judgeRelease(const Received& request, const Knowledge& knowledge, double least);

  WatchLimits limits_;
  Received last_;
  Knowledge last_knowledge_;
  double released_from_ = -1;  // force when the host learnt of the lost reference [N]; negative: it did not
  double largest_step_ = 0, largest_force_ = 0;
  std::vector<std::string> violations_;
};

/// Of a motor's word each, with the grip where `rates` holds [N].
Vec3 forceOf(const std::array<int, 3>& counts, const Mat3& rates);
/// What rounding every word may change of it [N].
double roundingOf(const Mat3& rates);

}  // namespace presa::falcon_model
