#pragma once
#include <cstdint>
#include <limits>

#include "framework/core/math/random.h"
#include "devices/simulated_subject/model/perception.h"
#include "devices/simulated_subject/model/traits.h"

namespace presa::subject {

/// What is asked of the subject, and where its hand begins.
struct Task {
  double reach = 0;  ///< way of each digit to the object [m]; 0: begins in touch
  /// Lets an object that slipped go, and takes it up from where it is seen to lie; else it is handed back in the air.
  bool from_table = false;
  double height = 0.04;  ///< to lift it [m]
  double hold = 10;      ///< to hold it still with the least grip it thinks necessary [s]
  double most_grip = std::numeric_limits<double>::infinity();  ///< beyond it the device yields [N]
  double device_resolution = 0;  ///< position steps of the device, which the subject has learnt to allow for [m]
};

/// Grips, lifts, loosens until it slips (to learn how hard it must grip), holds, lets go. Knows the world by `Senses` alone
/// (the stiffness and the weight of the object are felt), but for Task::device_resolution, and sees sliding while it lifts.
///   grip aimed at = S / (1 - margin) + clearance sqrt((cv S / (1 - margin))^2 + s0^2 + (k dX)^2 / 12 + (k dq)^2) + extra,
/// S the grip felt when slip was noticed. That uncertainty of force from position is kept clear of slip is the explanation
/// of [Bergamasco et al., section 3.6.4] written down: the sign of the effect of stiffness is put in here.
/// Thread: any, haptic included (nothing allocates).
class Brain {
 public:
  Brain(const Traits& traits, const Task& task, RandomStream perception, double period);
  /// One period later, with what was felt and seen in it.
  const Intent& step(const Senses& senses) noexcept;

  const Intent& intent() const noexcept { return intent_; }
  Phase phase() const noexcept { return phase_; }
  double timeInPhase() const noexcept { return time_; }    ///< [s]
  double slipGrip() const noexcept { return slip_grip_; }  ///< remembered grip at which it slipped [N]; 0: not yet
  double wanted() const noexcept { return wanted_; }       ///< grip aimed at [N]
  int drops() const noexcept { return drops_; }            ///< lost although it meant to hold
  int regrips() const noexcept { return regrips_; }        ///< squeezed harder after a slip noticed
  /// Drawn for this trial: kick noticed as slip [m], factors on the slip force remembered and on the grip wanted.
  double slipThreshold() const noexcept { return slip_threshold_; }
  double misjudgement() const noexcept { return misjudgement_; }
  double scatter() const noexcept { return scatter_; }
  const Perception& perception() const noexcept { return perception_; }

 private:
  void enter(Phase phase) noexcept;
  void reach() noexcept;
  void preload() noexcept;
  void load() noexcept;
  void settle() noexcept;
  void loosen() noexcept;
  void regrasp() noexcept;
  void regraspFromTable() noexcept;
  void adjust() noexcept;
  void hold() noexcept;
  void release() noexcept;
  void open() noexcept;

  bool slipFelt() const noexcept;
  bool slipSeen() const noexcept;
  /// While the object is seen to stay behind: true.
  bool squeezeWhenSliding() noexcept;
  double gripFromMemory() const noexcept;
  void takeUpAgain() noexcept;
  /// Lost: picks it up again to hold it harder. Slips: squeezes after the reaction time. True when lost.
  bool keepHold() noexcept;

  const Traits traits_;
  const Task task_;
  const double period_, loosen_per_tick_, adjust_per_tick_;
  double slip_threshold_, misjudgement_, scatter_;  // of this trial
  Perception perception_;
  Intent intent_;
  double effort_ = 0;
  Phase phase_ = Phase::kPreload;
  double time_ = 0, waited_ = 0;
  double low_ = 0, aside_ = 0;      // where the object lies [m]
  double firm_ = 0, firmness_ = 1;  // grip to take it up with [N], and more of it after a failure
  double reaction_;                 // left until it reacts; infinite: to nothing
  double felt_weight_ = 0;
  double slip_grip_ = 0, wanted_ = 0;
  int drops_ = 0, regrips_ = 0;
};

}  // namespace presa::subject
