#pragma once
#include <memory>
#include <string>
#include <vector>

#include "framework/core/diagnostics/diagnostics.h"
#include "framework/core/math/minimum_jerk.h"
#include "framework/core/math/spatial.h"

namespace presa {

/// What a scripted hand wants one fingertip to do at one moment.
struct MotionTarget {
  Vec3 p_WT = Vec3::Zero();      ///< wanted position of the fingertip centre [m]
  Vec3 v_WT = Vec3::Zero();      ///< its velocity [m/s]
  Vec3 force_W = Vec3::Zero();   ///< force pushed besides [N]
  Vec3 inward_W = Vec3::Zero();  ///< unit direction in which the grip is force-controlled; zero: not gripping
  double grip = 0;               ///< wanted grip force along inward_W [N]
  int phase = -1;
};

/// Impedance of the finger behind the fingertip. damping 0: derived from the rest ("auto").
struct FingerImpedance {
  double mass = 0.1;       ///< fingertip with thimble [kg]
  double stiffness = 300;  ///< hand [N/m]
  double damping = 0;      ///< [N s/m]
};

/// A motion of one fingertip as a function of simulated time. Immutable after reading.
class Motion {
 public:
  virtual ~Motion() = default;
  virtual MotionTarget at(double time) const noexcept = 0;
  virtual FingerImpedance impedance() const { return {}; }
  std::vector<std::string> phase_names;
  std::vector<double> phase_times;  ///< start of each phase, one more for the end [s]

 protected:
  /// Phase at a time; the last one holds on after the end.
  int phaseAt(double time) const noexcept;
};

/// Where the motion is used.
struct MotionContext {
  std::string role;
  double side = 1;              ///< -1: on the negative end of the grasp axis (thumb), +1: on the positive (index)
  double fingertip_radius = 0;  ///< [m]
};

/// Phases with grip, move and opening (XML, config/schema/motion.xsd). Null with findings when wrong.
std::unique_ptr<Motion> readPhasedMotion(const std::string& file, const MotionContext& context,
                                         Diagnostics& diagnostics);
/// Keyframes (CSV): header `time_s,role,x_m,y_m,z_m` and optionally `fx_N,fy_N,fz_N`, `phase`; minimum-jerk
/// between keyframes of one role. Null with findings when wrong.
std::unique_ptr<Motion> readKeyframeMotion(const std::string& file, const MotionContext& context,
                                           Diagnostics& diagnostics);

}  // namespace presa
