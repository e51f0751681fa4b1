#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "framework/core/exchange/bounded_list.h"
#include "framework/core/math/spatial.h"
#include "framework/core/state/limits.h"

namespace presa {

/// Motion of one body over one dynamics step.
struct BodyMotion {
  Pose X_WB_begin;           ///< pose at ObjectState::time_begin
  Pose X_WB_end;             ///< pose at ObjectState::time_end
  Vec3 v_WB = Vec3::Zero();  ///< velocity of the body frame's origin at time_end [m/s]
  Vec3 w_WB = Vec3::Zero();  ///< angular velocity at time_end [rad/s]
  bool asleep = false;       ///< at rest: the engine leaves it out until something wakes it
  std::int32_t island = -1;  ///< the same for bodies in contact, by way of free bodies; -1: the engine does not say
};

/// Faults of the dynamics (ObjectState::faults).
enum ObjectFault : std::uint32_t {
  kFaultBodyFrozen = 1,    ///< a body's state was not finite or implausible: the body is frozen
  kFaultEngineFailed = 2,  ///< the engine failed: all bodies are frozen
  kFaultBadFinger = 4,     ///< a finger contact was implausible and was ignored
  kFaultBadEffect = 8,     ///< a body effect gave no number or a wrench above its bound: all of them are off
};

/// Penetration depth over all contact points between bodies (fixed ones included, fingers not) at the start of the last
/// sub-step of the step just solved. Contacts of sleeping bodies with sleeping or fixed ones are not counted.
struct BodyPenetration {
  static constexpr std::int32_t kUnknown = -1;  ///< `points` of an engine that does not say
  std::int32_t points = kUnknown;  ///< kUnknown: the engine does not report penetration, and the depths are NaN
  double mean = std::numeric_limits<double>::quiet_NaN();   ///< [m]; 0 where nothing touches
  double worst = std::numeric_limits<double>::quiet_NaN();  ///< [m]; 0 where nothing touches
};

/// Energy that appeared from nothing since the start: the bodies' gain beyond the work of fingers and external forces.
/// Zero in nature; a method's error, or the push that separates bodies which overlapped. NaN: the engine does not say.
struct EnergyCreated {
  double sum = std::numeric_limits<double>::quiet_NaN();         ///< [J]
  double worst_step = std::numeric_limits<double>::quiet_NaN();  ///< the most in one step [J]
};

/// Impulse that one finger gave to one body since the finger came to it.
struct FingerImpulse {
  std::int32_t finger = 0,        ///< index into the scene's roles
      body = kNoBody;             ///< index into Scene::bodies
  double since = 0;               ///< time_begin of the first step with this contact [s]
  Vec3 impulse_W = Vec3::Zero();  ///< on the body; of a held body without what is predicted for a later tick [N s]
  double until = kNoEnd;          ///< up to which it is counted [s]; kNoEnd: to time_end
  static constexpr double kNoEnd = std::numeric_limits<double>::infinity();  ///< `until` of a contact that still lasts
};

/// Object State: motion of every body of the scene (fixed ones too, in scene order) over the step just solved.
/// A reader interpolates between time_begin and time_end to its own "now", so that no pose jumps when a new state
/// is published (a jump of one 5 ms step costs a factor five in stable stiffness).
/// The dynamics sizes it by the scene before the first step; its length then stays constant.
/// Written by: dynamics thread.
struct ObjectState {
  double time_begin = 0;     ///< [s]
  double time_end = 0;       ///< [s], time_begin + dynamics period
  std::uint32_t faults = 0;  ///< ObjectFault bits since the start; forces fade for good when any is set
  /// Steps since the start in which an island had to change from the direct to the iterative solver.
  std::uint64_t fallback_steps = 0;
  BodyPenetration penetration;      ///< unknown until the first step
  EnergyCreated energy;             ///< NaN until the engine says it
  std::uint64_t stopped_short = 0;  ///< since the start: how often a body was stopped short of passing through another
  std::uint64_t too_many_held = 0;  ///< how often a group of bodies was too large for the haptic thread to move
  double held_time = -1;  ///< of the newest bodies moved by the haptic thread that this state knows [s]; -1: none
  double far_lag = 0;     ///< since the start, for which bodies stood still that no finger reaches: late dynamics [s]
  /// Impulse that each finger gave to the bodies since the start, in W [N s]. Its mean slope is the mean force [N].
  std::vector<Vec3> finger_impulse_W;
  BoundedList<FingerImpulse> touches;  ///< the same by finger and moving body, of the contacts of the step just solved
  std::vector<BodyMotion> bodies;      ///< in scene order, the fixed ones too

  std::int32_t count() const noexcept { return static_cast<std::int32_t>(bodies.size()); }  ///< bodies of the scene
  /// Heap memory that it owns [bytes] (SizedAtLoad).
  std::size_t roomBytes() const noexcept {
    return bodies.capacity() * sizeof(BodyMotion) + finger_impulse_W.capacity() * sizeof(Vec3) + touches.roomBytes();
  }

  /// Pose X_WB of body i, 0 <= i < count(), at time t [s]; t is clamped to [time_begin, time_end].
  Pose poseAt(std::int32_t i, double t) const {
    const BodyMotion& body = bodies[static_cast<std::size_t>(i)];
    const double span = time_end - time_begin;
    if (!(span > 0)) return body.X_WB_end;
    return interpolate(body.X_WB_begin, body.X_WB_end, std::clamp((t - time_begin) / span, 0.0, 1.0));
  }
};

/// Port of the Object State in which bodies that the haptic thread itself moves are where it has moved them; exists
/// only in runs with such bodies, on the haptic thread.
inline constexpr const char* kShownObjectsPort = "shown_objects";

}  // namespace presa
