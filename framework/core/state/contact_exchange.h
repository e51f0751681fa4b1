#pragma once
#include <algorithm>
#include <array>
#include <cstdint>

#include "framework/core/math/spatial.h"
#include "framework/core/state/limits.h"

namespace presa {

/// Numbers as in figure 12 of the PERCRO paper: 0 no contact, 1 not slipping, 2 slipping.
enum class ContactMode : std::int32_t { kNone = 0, kStick = 1, kSlip = 2 };

/// One body's share of a contact force that several bodies bear. The shares add up to the spring from HIP to proxy.
struct ContactPart {
  std::int32_t body = kNoBody;
  Vec3 p_BP = Vec3::Zero();       ///< proxy, coordinates of `body` [m]
  Vec3 nhat_B = Vec3::UnitZ();    ///< direction of its normal force on the finger, coordinates of `body`
  Vec3 stretch_W = Vec3::Zero();  ///< force on the body: -stiffness * stretch_W; sum over parts: p_WP - p_WH [m]
};
inline constexpr std::size_t kMaxContactParts = 3;  ///< three planes fix a point in space

/// Contact of one finger. nhat points from the body into the finger; depth >= 0 when they overlap.
struct FingerContact {
  ContactMode mode = ContactMode::kNone;
  std::int32_t body = kNoBody;
  Vec3 p_WH = Vec3::Zero();                ///< HIP (haptic interface point) [m]
  Vec3 v_WH = Vec3::Zero();                ///< [m/s]
  Vec3 p_WP = Vec3::Zero();                ///< proxy: centre of the fingertip sphere held at the surface [m]
  Vec3 p_BP = Vec3::Zero();                ///< the same in coordinates of `body` (in W when `body` is kNoBody) [m]
  Vec3 p_BC = Vec3::Zero();                ///< touched surface point, coordinates of `body` [m]
  Vec3 nhat_B = Vec3::UnitZ();             ///< surface normal, body into finger, coordinates of `body`
  Vec3 nhat_W = Vec3::UnitZ();             ///< the same in W
  double depth = 0;                        ///< (p_WP - p_WH) . nhat_W [m]
  double stiffness = 0;                    ///< [N/m]
  double damping = 0;                      ///< [N s/m]
  double friction_static = 0;              ///< bound of tangential over normal force while sticking
  double friction_dynamic = 0;             ///< the same while slipping
  double tangential_ratio = 1;             ///< tangential stiffness / stiffness
  double tangential_damping = 0;           ///< [N s/m]
  Vec3 damped_W = Vec3::Zero();            ///< part of p_WP - p_WH that tangential damping causes [m]
  double normal_force = 0;                 ///< f_H_W . nhat_W [N], >= 0
  Vec3 tangential_force_W = Vec3::Zero();  ///< f_H_W without its normal part [N]
  Vec3 f_H_W = Vec3::Zero();               ///< rendered force on the finger, before the output stage [N]
  Vec3 t_H_W = Vec3::Zero();               ///< rendered torque about H on an oriented tool [N m]; 0 on others
  /// Above 1: several bodies hold the finger, `body` the largest share; `parts` lists them. Otherwise `body` bears all.
  std::int32_t part_count = 0;
  std::array<ContactPart, kMaxContactParts> parts;
};

/// Contacts and rendered forces of one haptic tick, for the dynamics, the collision query, the
/// output stage, the view and the recorder. Written by: haptic thread.
struct ContactExchange {
  double time = 0;         ///< [s]
  std::int32_t count = 0;  ///< fingers in use
  /// Since start: ticks in which a fingertip missed surfaces in its reach, because they exceeded a fixed capacity.
  std::uint32_t coverage_lost = 0;
  std::uint32_t pop_through = 0;  ///< since start: how often the centre of a fingertip crossed a surface
  std::array<std::uint32_t, kMaxFingers> pop_through_by_finger{};  ///< the same for each finger
  /// Ticks in which the proxy lost its hold on the surface (out of a fold, over a ridge) and slid along a free path to
  /// the next place that holds it, farther than the motion of the HIP and the bodies explains.
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
