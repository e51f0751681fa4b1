#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "framework/core/schedule/timing_stats.h"
#include "framework/record/haptic_observer.h"
#include "framework/record/monitor/action_reaction.h"
#include "framework/scene/world.h"

namespace presa {

/// A transition from stick to slip on the same body: values of the first slipping tick and of the tick before it.
struct SlipOnset {
  double time = -1;  ///< first slipping tick [s]; -1: no slip
  std::int32_t body = kNoBody;
  double normal_force = 0;                 ///< first slipping tick [N]
  double tangential_force = 0;             ///< magnitude, first slipping tick [N]
  double last_stick_normal_force = 0;      ///< tick before [N]
  double last_stick_tangential_force = 0;  ///< magnitude, tick before: friction force at the onset of slip [N]
};
inline constexpr std::size_t kMaxSlipOnsets = 64;  ///< stored per finger; further ones are only counted

/// Contact summary of one finger over a run. Forces are those rendered, which the output stage limits before the device
/// gets them. While forces fade after a stop, the hand closes on what no longer pushes back: then rendered forces, slips
/// and losses say nothing about the grasp and do not count.
struct FingerSummary {
  std::array<double, 3> seconds{};  ///< by ContactMode: none, stick, slip
  double max_normal_force = 0;      ///< [N]
  double mean_normal_force = 0;     ///< over the ticks in contact [N]
  double max_commanded_force = 0;   ///< magnitude of what the device was sent, in all ticks [N]
  std::uint32_t pop_through = 0;    ///< times that the fingertip passed through a surface
  double first_pop_through = -1;    ///< [s]; -1: never
  std::uint32_t leaps = 0;          ///< ticks in which the proxy left a fold (ContactExchange::leaps_by_finger)
  std::uint64_t slip_onsets = 0;    ///< changes from stick to slip
  SlipOnset release_slip;           ///< first slip onset at or after release_time
  ActionReaction::Result reaction;  ///< impulse given to free bodies against impulse rendered
};

/// A grasp regained within this time does not count as lost [s].
inline constexpr double kBounceTime = 0.05;

struct ObjectSummary {
  Vec3 start = Vec3::Zero(), highest = Vec3::Zero(), final = Vec3::Zero();  ///< body origins [m]
  bool grasped = false;                                                     ///< at least two fingers held it at once
  double lost_at = -1;    ///< first tick without contact after a grasp, not regained within kBounceTime [s]; -1: never
  bool dropped = false;   ///< lost before the motion meant to let go
  double peak_speed = 0;  ///< [m/s]
};

/// Min and max of a quantity over some ticks.
struct TraceRange {
  double min = 0, max = 0;
  void begin(double value) noexcept { min = max = value; }
  void add(double value) noexcept {
    min = value < min ? value : min;
    max = value > max ? value : max;
  }
};
/// Ranges of one finger over every tick from a trace sample up to the next, so that a plot shows what the decimated
/// samples miss: 80 Hz in samples at 125 Hz.
struct TraceRanges {
  TraceRange height, proxy_height;  ///< along z [m]
  TraceRange rendered_normal, rendered_tangential;
  TraceRange commanded_normal, commanded_tangential;  ///< after the output stage, see partsOf() [N]
};

/// Part of a force on the finger that presses along the normal, and the rest [N]. Without contact there is no normal:
/// then all of the force counts as its normal part, so that none is left out.
struct ForceParts {
  double normal = 0, tangential = 0;
};
ForceParts partsOf(const Vec3& f_H_W, const FingerContact& contact) noexcept;

/// One sample of the plots, with the quantities of figure 12 of the PERCRO paper.
struct TraceSample {
  double time = 0;
  std::int32_t phase = -1;
  std::vector<FingerContact> fingers;  ///< HIP, proxy, mode, forces
  std::vector<Vec3> f_command;         ///< after the output stage [N]
  std::vector<TraceRanges> ranges;     ///< by finger
  std::array<Pose, 4> bodies;          ///< poses of the first four free bodies
};

/// Haptic-rate observer: summaries, state hash and a decimated trace. Allocates all memory at construction. Read the
/// results after the executor has stopped.
class Monitor final : public HapticObserver {
 public:
  /// `duration` of the run [s] bounds the trace. `release_time`: when the motion lets go on purpose [s]; infinity: never,
  /// so that every loss is a drop; NaN: nobody says, so that none is. `trace_rate` [Hz]; 0: no trace.
  Monitor(std::shared_ptr<const World> world, double duration, double release_time, double trace_rate);
  ~Monitor() override;
  /// Without dynamics, bodies keep their start poses. An object state is summed and hashed when its version changes.
  void observe(const HapticSample& sample) noexcept override;
  std::vector<std::string> stages() const override;

  /// In the order of the scene's roles.
  const std::vector<FingerSummary>& fingers() const noexcept;
  /// Same order as Scene::bodies.
  const std::vector<ObjectSummary>& objects() const noexcept;
  /// The first kMaxSlipOnsets of one finger, in time order.
  const std::vector<SlipOnset>& slipOnsets(std::size_t finger) const noexcept;
  /// State hash of the run, see StateHash.
  std::uint64_t hash() const noexcept;
  const BoundedList<TraceSample>& trace() const noexcept;
  /// Scene indices of the bodies in TraceSample::bodies.
  const std::vector<std::int32_t>& tracedBodies() const noexcept;
  std::uint32_t popThrough() const noexcept;
  /// Ticks in which a fingertip had no complete list of the surfaces in its reach, summed over the fingers, and the
  /// time of the first [s]; -1: none.
  std::uint32_t coverageLost() const noexcept;
  double firstCoverageLost() const noexcept;
  double simulatedTime() const noexcept;
  double stoppedAt() const noexcept;  ///< first tick of a stop before the end [s]; -1: none
  /// ObjectFault bits that occurred, and the time of the first [s]; -1: none.
  std::uint32_t objectFaults() const noexcept;
  double objectFaultTime() const noexcept;
  /// Dynamics steps in which the direct solver failed on an island and the iterative solver replaced it.
  std::uint64_t solverFallbacks() const noexcept;
  /// Energy that appeared from nothing in the dynamics; NaN where the engine does not say.
  const EnergyCreated& energyCreated() const noexcept;
  /// Dynamics steps in which a body was stopped short of passing through another, summed over the bodies.
  std::uint64_t stoppedShort() const noexcept;
  /// How often a group of bodies was too large for the haptic thread to move.
  std::uint64_t tooManyHeld() const noexcept;
  double farLag() const noexcept;  ///< ObjectState::far_lag [s]

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace presa
