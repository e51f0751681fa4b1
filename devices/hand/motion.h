#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "framework/core/diagnostics/diagnostics.h"
#include "framework/core/math/spatial.h"
#include "framework/device/minimum_jerk.h"
#include "framework/device/phase_intent.h"

namespace presa {

/// Target of a scripted fingertip at one moment.
struct MotionTarget {
  Vec3 p_WT = Vec3::Zero();      ///< wanted position of the fingertip centre [m]
  Vec3 v_WT = Vec3::Zero();      ///< its velocity [m/s]
  Vec3 force_W = Vec3::Zero();   ///< additional force of the hand [N]
  Vec3 inward_W = Vec3::Zero();  ///< unit direction of force control while gripping; zero: not gripping
  double grip = 0;               ///< wanted grip force along inward_W [N]
  int phase = -1;
  Quat q_WT = Quat::Identity();  ///< wanted orientation of the tool
  Vec3 w_WT = Vec3::Zero();      ///< its angular velocity [rad/s]
};

/// Impedance of the hand at the fingertip. damping 0: chosen automatically ("auto").
struct FingerImpedance {
  double mass = 0.1;       ///< fingertip with thimble [kg]
  double stiffness = 300;  ///< of the hand [N/m]
  double damping = 0;      ///< [N s/m]
};

/// A motion of one fingertip as a function of simulated time. Immutable after reading.
class Motion {
 public:
  virtual ~Motion() = default;
  virtual MotionTarget at(double time) const noexcept = 0;
  virtual FingerImpedance impedance() const { return {}; }
  /// Buttons that the hand holds in a phase, as FingerInput::buttons, and the number of buttons that it has.
  std::uint32_t buttonsIn(int phase) const noexcept;
  int buttons() const noexcept;
  std::vector<std::string> phase_names;
  bool oriented = false;                     ///< the motion says how the tool turns
  std::vector<PhaseIntent> phase_intents;    ///< of each phase
  std::vector<std::uint32_t> phase_buttons;  ///< that the hand holds during each phase; shorter: none in the others
  std::vector<double> phase_times;           ///< start of each phase, then the end of the last one [s]

 protected:
  /// Phase at a time; after the end, the last phase.
  int phaseAt(double time) const noexcept;
};

/// The fingertip that a motion is read for.
struct MotionContext {
  std::string role;
  double side = 1;              ///< -1: on the negative end of the grasp axis (thumb), +1: on the positive (index)
  double fingertip_radius = 0;  ///< [m]
};

/// Reads phases with grip, move and opening (XML, config/schema/motion.xsd). Null with findings on errors.
std::unique_ptr<Motion> readPhasedMotion(const std::string& file, const MotionContext& context,
                                         Diagnostics& diagnostics);
/// Reads keyframes (CSV): header `time_s,role,x_m,y_m,z_m` and optionally `fx_N,fy_N,fz_N`, `qw,qx,qy,qz` (orientation of the
/// tool as a quaternion), `phase`, `intent`; minimum-jerk interpolation between keyframes of one role. Null with findings on errors.
std::unique_ptr<Motion> readKeyframeMotion(const std::string& file, const MotionContext& context,
                                           Diagnostics& diagnostics);

}  // namespace presa
