#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "framework/core/exchange/bounded_list.h"
#include "framework/core/math/spatial.h"
#include "framework/core/state/limits.h"

namespace presa {

/// Numbers as in figure 12 of the PERCRO paper: 0 no contact, 1 not slipping, 2 slipping.
enum class ContactMode : std::int32_t { kNone = 0, kStick = 1, kSlip = 2 };

/// A finger's contact with one body: a spring-damper with a friction of its own. The forces of all contacts of a finger
/// add up to its own.
struct ToolContact {
  std::int32_t body = kNoBody;    ///< index into Scene::bodies
  Vec3 p_BP = Vec3::Zero();       ///< where the force acts: the proxy, coordinates of `body` [m]
  Vec3 p_WP = Vec3::Zero();       ///< the same in W [m]
  Vec3 nhat_B = Vec3::UnitZ();    ///< direction of the normal force on the finger, coordinates of `body`
  Vec3 v_WH = Vec3::Zero();       ///< velocity of the spring's end at the finger [m/s]
  Vec3 stretch_W = Vec3::Zero();  ///< spring force on the finger: stiffness * stretch_W [m]
  double depth = 0;               ///< part of stretch_W along the normal [m]
  double stiffness = 0;           ///< [N/m]
  double damping = 0;             ///< along the normal [N s/m]
  // friction, as in FingerContact
  ContactMode mode = ContactMode::kNone;  ///< at this body
  double friction_static = 0;             ///< bound of tangential over normal force while sticking
  double friction_dynamic = 0;            ///< the same while slipping
  double tangential_ratio = 1;            ///< tangential stiffness / stiffness
  double tangential_damping = 0;          ///< share of the finger's [N s/m]
  Vec3 damped_W = Vec3::Zero();           ///< part of stretch_W that tangential damping causes [m]
  Vec3 f_H_W = Vec3::Zero();              ///< rendered force on the finger, damping and friction included [N]
};

/// Contact of one finger. nhat: from the body into the finger; depth >= 0 when they overlap. Of several bodies that hold
/// it, `body` bears the largest share and gives the friction; mode (slip: all slip), depth and forces are of the whole.
struct FingerContact {
  ContactMode mode = ContactMode::kNone;   ///< of the whole contact; kNone: `body` is kNoBody
  std::int32_t body = kNoBody;             ///< index into Scene::bodies; kNoBody: none
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
  Vec3 impulse_H_W = Vec3::Zero();         ///< of f_H_W since the start; averaged coupling only [N s]
  Vec3 t_H_W = Vec3::Zero();               ///< rendered torque about H on an oriented tool [N m]; 0 on others
  // Torsional friction of an oriented tool on a soft fingertip's material: -twist_stiffness * twist about nhat_W.
  double twist = 0;                 ///< turn of the tool over `body` about nhat_W that the contact holds [rad]
  double twist_stiffness = 0;       ///< [N m/rad]; 0: no such torque
  double spin = 0;                  ///< angular velocity of the tool about nhat_W [rad/s]
  bool twist_slips = false;         ///< the torque is that of dynamic friction
  std::uint32_t first_contact = 0;  ///< index into ContactExchange::contacts
  std::uint32_t contact_count = 0;  ///< bodies that hold the finger
  bool has_volume = false;          ///< a tool: only its contacts say where forces act
};

/// Contacts and rendered forces of one haptic tick, for the dynamics, the collision query, the
/// output stage, the view and the recorder. The haptic module sizes it by the scene at load. Written by: haptic thread.
struct ContactExchange {
  double time = 0;  ///< [s]
  /// Since start: ticks in which a fingertip missed surfaces in its reach, because they exceeded a fixed capacity.
  std::uint32_t coverage_lost = 0;
  std::uint32_t pop_through = 0;  ///< since start: how often the centre of a fingertip crossed a surface
  std::vector<std::uint32_t> pop_through_by_finger;  ///< the same for each finger
  /// Ticks in which the proxy lost its hold on the surface (out of a fold, over a ridge) and slid along a free path to
  /// the next place that holds it, farther than the motion of the HIP and the bodies explains.
  std::vector<std::uint32_t> leaps_by_finger;
  std::vector<FingerContact> fingers;  ///< in the order of the scene's roles
  BoundedList<ToolContact> contacts;   ///< of all fingers, those of one finger in a row

  ContactExchange() = default;  ///< of no finger
  /// Allocates for `finger_count` fingers and their contacts.
  explicit ContactExchange(std::size_t finger_count, std::size_t contacts_per_finger = 1)
      : pop_through_by_finger(finger_count),
        leaps_by_finger(finger_count),
        fingers(finger_count),
        contacts(finger_count * contacts_per_finger) {}

  std::int32_t count() const noexcept { return static_cast<std::int32_t>(fingers.size()); }  ///< fingers
  /// Contacts of one of `fingers`, in place.
  std::span<const ToolContact> contactsOf(const FingerContact& finger) const noexcept {
    return {contacts.begin() + finger.first_contact, finger.contact_count};
  }
  /// Heap memory that it owns [bytes] (SizedAtLoad).
  std::size_t roomBytes() const noexcept {
    return fingers.capacity() * (sizeof(FingerContact) + 2 * sizeof(std::uint32_t)) + contacts.roomBytes();
  }
};

}  // namespace presa
