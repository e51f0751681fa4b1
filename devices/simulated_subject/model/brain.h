#pragma once
#include <cstdint>
#include <limits>

#include "devices/simulated_subject/model/perception.h"
#include "devices/simulated_subject/model/subject_parameters.h"
#include "framework/core/math/random.h"

namespace presa::subject {

/// Instructions to the subject, and the start of its hand.
struct Task {
  double reach = 0;  ///< distance of each digit to the object at the start [m]; 0: in contact
  /// Releases an object that slipped and picks it up from where it lies; false: the object is handed back in the air.
  bool from_table = false;
  double height = 0.04;  ///< lift height [m]
  double hold = 10;      ///< duration of holding still with the min grip that the subject considers necessary [s]
  double max_grip = std::numeric_limits<double>::infinity();  ///< force limit of the device [N]
  double device_resolution = 0;  ///< position steps of the device, which the subject has learnt [m]
};

/// Grips, lifts, loosens until the object slips (to learn the necessary grip), holds, releases. Its knowledge of the
/// world is `Afferents` (it feels the stiffness and weight of the object and sees sliding while it lifts) and
/// Task::device_resolution. The wanted grip is
///   S / (1 - margin) + clearance sqrt((cv S / (1 - margin))^2 + s0^2 + (k dX)^2 / 12 + (k dq)^2) + extra,
/// where S is the grip at which slip was noticed. The clearance of the force uncertainty from position implements the
/// explanation of [Bergamasco et al., section 3.6.4]: the sign of the effect of stiffness is built in, not found.
/// Thread: any, haptic included (nothing allocates).
class Brain {
 public:
  Brain(const SubjectParameters& parameters, const Task& task, RandomStream perception, double period);
  /// Advances one period with the senses of that period.
  const MotorCommand& step(const Afferents& afferents) noexcept;

  const MotorCommand& command() const noexcept { return command_; }
  Phase phase() const noexcept { return phase_; }
  double timeInPhase() const noexcept { return time_; }    ///< [s]
  double slipGrip() const noexcept { return slip_grip_; }  ///< remembered grip at the slip [N]; 0: none yet
  double wanted() const noexcept { return wanted_; }       ///< wanted grip [N]
  int drops() const noexcept { return drops_; }            ///< losses of the object while trying to hold it
  int regrips() const noexcept { return regrips_; }        ///< squeezes after a noticed slip
  /// Drawn per trial: kick noticed as slip [m]; factors on the remembered slip force and on the wanted grip.
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
  /// Raises the grip while the object is seen to slide; true if so.
  bool squeezeWhenSliding() noexcept;
  double gripFromMemory() const noexcept;
  void takeUpAgain() noexcept;
  /// When the object is lost, picks it up again with more force and returns true. After a slip, squeezes once the
  /// reaction time is over.
  bool keepHold() noexcept;

  const SubjectParameters parameters_;
  const Task task_;
  const double period_, loosen_per_tick_, adjust_per_tick_;
  double slip_threshold_, misjudgement_, scatter_;  // drawn for this trial
  Perception perception_;
  MotorCommand command_;
  double effort_ = 0;
  Phase phase_ = Phase::kPreload;
  double time_ = 0, waited_ = 0;
  double low_ = 0, aside_ = 0;      // position of the object when it lies [m]
  double firm_ = 0, firmness_ = 1;  // grip for picking up [N], and its factor after failures
  double reaction_;                 // time left until the reaction; infinite: none pending
  double felt_weight_ = 0;
  double slip_grip_ = 0, wanted_ = 0;
  int drops_ = 0, regrips_ = 0;
};

}  // namespace presa::subject
