#pragma once
#include <algorithm>
#include <array>
#include <cstdint>

#include "framework/core/math/spatial.h"
#include "framework/core/state/limits.h"

namespace presa {

/// Numbers as in figure 12 of the PERCRO paper: 0 no contact, 1 not slipping, 2 slipping.
enum class ContactMode : std::int32_t { kNone = 0, kStick = 1, kSlip = 2 };

/// One body's part of a contact that several bodies bear: the spring from the HIP to the proxy, as far as this body holds it.
struct ContactPart {
  std::int32_t body = kNoBody;
  Vec3 p_BP = Vec3::Zero();       ///< proxy, coordinates of `body` [m]
  Vec3 nhat_B = Vec3::UnitZ();    ///< direction of its normal force on the finger, coordinates of `body`
  Vec3 stretch_W = Vec3::Zero();  ///< the body gets -stiffness times this; over all parts the sum is p_WP - p_WH [m]
};
inline constexpr std::size_t kMaxContactParts = 3;  ///< a point in space is held by three planes

/// What one finger does to one body. Convention: nhat points from the body into the finger,
/// depth >= 0 when overlapping; f_H_W is the force on the finger, the body gets its negative.
struct FingerContact {
  ContactMode mode = ContactMode::kNone;
  std::int32_t body = kNoBody;
  Vec3 p_WH = Vec3::Zero();     ///< HIP [m]
  Vec3 v_WH = Vec3::Zero();     ///< [m/s]
  Vec3 p_WP = Vec3::Zero();     ///< proxy: centre of the fingertip sphere held at the surface [m]
  Vec3 p_BP = Vec3::Zero();     ///< the same in coordinates of `body` (W when none)
  Vec3 p_BC = Vec3::Zero();     ///< touched surface point, coordinates of `body`
  Vec3 nhat_B = Vec3::UnitZ();  ///< surface normal, body into finger, coordinates of `body`
  Vec3 nhat_W = Vec3::UnitZ();  ///< the same in W
  double depth = 0;             ///< (p_WP - p_WH) . nhat_W [m]
  double stiffness = 0;         ///< [N/m]
  double damping = 0;           ///< [N s/m]
  double friction_static = 0;
  double friction_dynamic = 0;
  double normal_force = 0;                 ///< f_H_W . nhat_W [N], >= 0
  Vec3 tangential_force_W = Vec3::Zero();  ///< f_H_W without its normal part [N]
  Vec3 f_H_W = Vec3::Zero();               ///< rendered force on the finger, before the output stage [N]
  /// More than one: several bodies hold the finger, `body` the most, and each bears its own part. Otherwise `body` bears all.
  std::int32_t part_count = 0;
  std::array<ContactPart, kMaxContactParts> parts;
};

/// Contact exchange: what the haptic thread found in one tick, for the dynamics, the collision
/// query, the output stage, the view and the recorder. Written by: haptic thread.
struct ContactExchange {
  double time = 0;  ///< [s]
  std::int32_t count = 0;
  /// Ticks in which a fingertip could not see every surface in its reach, since start: more bodies, or more triangles that it
  /// touches at once, than there is room for.
  std::uint32_t coverage_lost = 0;
  std::uint32_t pop_through = 0;  ///< times the centre of a fingertip crossed a surface, since start
  std::array<std::uint32_t, kMaxFingers> pop_through_by_finger{};  ///< the same, finger by finger
  /// Ticks in which a surface no longer held a finger where it was (out of a fold, over a ridge) and it went on, along a way that it
  /// can take, to the next place that does: farther than what the HIP and the bodies moved accounts for.
  std::array<std::uint32_t, kMaxFingers> leaps_by_finger{};
  std::array<FingerContact, kMaxFingers> fingers;

  ContactExchange() = default;
  ContactExchange(const ContactExchange& other) { *this = other; }
  /// Copies only the fingers in use.
  ContactExchange& operator=(const ContactExchange& other) {
    if (this == &other) return *this;
    time = other.time;
    count = other.count;
    coverage_lost = other.coverage_lost;
    pop_through = other.pop_through;
    pop_through_by_finger = other.pop_through_by_finger;
    leaps_by_finger = other.leaps_by_finger;
    std::copy_n(other.fingers.begin(), std::clamp(other.count, 0, kMaxFingers), fingers.begin());
    return *this;
  }
};

}  // namespace presa
