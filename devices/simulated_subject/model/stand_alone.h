#pragma once
#include <array>
#include <cstdint>
#include <limits>

#include "devices/simulated_subject/model/brain.h"
#include "devices/simulated_subject/model/hand.h"

namespace presa::subject {

/// A cube between the digits, touched at the height of its centre. It moves along the grip and vertically.
struct Cube {
  double mass = 0;            ///< [kg]
  double mu_s = 0, mu_d = 0;  ///< static, dynamic friction
  double stiffness = 0;       ///< rendered stiffness [N/m]

  /// Min grip of each digit that carries the cube at rest [N].
  double slipForce() const noexcept { return mass * kGravity / (2 * mu_s); }
  static constexpr double kGravity = 9.81;  ///< [m/s^2]
};

/// One trial. Seed, subject and trial name the random streams, so the order of trials does not matter.
struct Trial {
  Cube cube;
  std::uint64_t seed = 1, subject = 0, trial = 0;
  double resolution = 0;    ///< position steps of the device [m]
  double force_limit = 10;  ///< peak of the device [N]
  double hold = 10;         ///< [s]
  double reach = 0;         ///< distance of each digit to the cube at the start [m]; 0: in contact
  double time_limit = 120;  ///< max duration of the trial [s]
};

inline constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kContinuousForce = 4;  ///< of the device in its worst pose [N] [Bergamasco et al., section 2.1]

/// External measures of a trial.
struct TrialResult {
  double grip = kNotMeasured, grip_sd = kNotMeasured;  ///< normal force, mean over the hold and both digits [N]
  double load = kNotMeasured;                          ///< same for the force that carries the cube [N]
  double slip_force = kNotMeasured;                    ///< grip at the first slip of the release [N]
  double notice_delay = kNotMeasured;                  ///< from the first slip of the loosening until it is noticed [s]
  double slip_grip = 0, wanted = 0;                    ///< the subject's remembered and wanted grip [N]
  double time_over_rating = 0;                         ///< with a digit above kContinuousForce [s]
  double peak = 0;                                     ///< largest normal force [N]
  double duration = 0;                                 ///< [s]
  int drops = 0, regrips = 0;
  bool completed = false;
};

/// Point contact of one digit with the cube: a spring along the normal; tangentially a proxy in object coordinates that
/// sticks within the static friction cone and slides at the dynamic one [Melder & Harwin 2004].
class DigitContact {
 public:
  enum class State : std::uint8_t { kFree, kStick, kSlip };
  /// Finger at `depth` inside the face and at `height` above the cube's centre [m].
  void step(const Cube& cube, double force_limit, double depth, double height) noexcept;
  /// Sticks with the proxy at `height`.
  void stick(double height) noexcept { state_ = State::kStick, proxy_ = height; }
  double normal() const noexcept { return normal_; }  ///< [N]
  double load() const noexcept { return load_; }      ///< on the finger, downwards [N]
  State state() const noexcept { return state_; }
  /// True if the proxy began to slide in this step.
  bool slipBegan() const noexcept { return slip_began_; }

 private:
  State state_ = State::kFree;
  double proxy_ = 0, normal_ = 0, load_ = 0;
  bool slip_began_ = false;
};

/// The subject in a small world at 1 kHz without the pipeline: quantised finger positions, spring contacts, and a cube
/// integrated by semi-implicit Euler. A baseline that shows the effect of the pipeline. Not mechanical: a lost cube is
/// handed back between the fingers, and the table carries the cube only until it is lifted.
/// Thread: any; step allocates nothing.
class StandAlone {
 public:
  static constexpr double kPeriod = 1e-3;

  StandAlone(const SubjectParameters& parameters, const Trial& trial);
  /// Advances one period; false when the trial is over.
  bool step() noexcept;
  /// Runs the trial to its end.
  TrialResult run() noexcept;
  TrialResult result() const noexcept;

  double time() const noexcept { return time_; }
  double cubeHeight() const noexcept { return y_; }
  const Brain& brain() const noexcept { return brain_; }
  const Hand& hand() const noexcept { return hand_; }
  const DigitContact& contact(int digit) const noexcept { return contacts_[digit]; }
  double meanNormal() const noexcept { return 0.5 * (contacts_[0].normal() + contacts_[1].normal()); }

 private:
  /// Sums over the hold phase.
  struct Hold {
    double count = 0, mean = 0, squares = 0, load = 0;
    void add(double normal, double load) noexcept;
  };
  void render() noexcept;
  void moveCube() noexcept;
  Afferents sense() const noexcept;
  void handBack() noexcept;
  void measure(Phase before) noexcept;

  const Trial trial_;
  Hand hand_;
  Brain brain_;
  std::array<DigitContact, kDigits> contacts_{};
  double x_ = 0, v_x_ = 0, y_ = 0, v_y_ = 0;  // cube, in the thumb's direction and up
  double time_ = 0;
  Hold hold_;
  double slip_began_at_ = kNotMeasured, slip_began_with_ = kNotMeasured;  // first slip since loosening or release began
  TrialResult result_;
};

}  // namespace presa::subject
