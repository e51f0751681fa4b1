#pragma once
#include <array>
#include <limits>
#include <span>

#include "devices/novint_falcon/force_gate.h"
#include "devices/novint_falcon/kinematics.h"
#include "devices/novint_falcon/link_state.h"
#include "devices/novint_falcon/loader.h"
#include "devices/novint_falcon/rating.h"
#include "devices/novint_falcon/sample_gate.h"

namespace presa::falcon {

struct LinkSettings {
  double period = 1e-3;                         ///< between two requests [s]
  double max_speed = kFastestGrip;              ///< [m/s]
  DeviceRating rating = kRating;                ///< for the force gate; tests may change it
  double counts_per_torque = kCountsPerTorque;  ///< [1/(N m)]
  int max_counts = kMaxCounts;
};

/// The commanded force on the grip.
struct LinkCommand {
  Vec3 f_H_D = Vec3::Zero();                               ///< force on the grip [N]
  double time = -std::numeric_limits<double>::infinity();  ///< time of the command on the link's clock [s]
};

/// The latest sample of the grip, in the device's frame D (kinematics.h).
struct LinkSample {
  Vec3 p_DH = Vec3::Zero(), v_DH = Vec3::Zero();  ///< [m], [m/s]
  std::uint8_t buttons = 0;                       ///< Button bits
  bool valid = false;                             ///< homed, in operation, and recent
  bool lost = false;                              ///< latched fault: no samples before a re-arm
};

/// The state of the link.
struct LinkStatus {
  LinkState state = LinkState::kClosed;
  LinkFault fault = LinkFault::kNone;
  LoadReport load;
  std::uint8_t homed = 0;  ///< of the last reply
  bool quiet = true;       ///< the last request had zero force
  bool loading = false;    ///< firmware upload in progress
  std::uint64_t requests = 0, replies = 0;
  std::uint64_t dropped = 0;   ///< bytes that did not belong to a reply
  std::uint64_t rejected = 0;  ///< physically impossible samples
};

/// The protocol of a Novint Falcon from the first control request to the last zero force, over any transport. It has no
/// clock: the caller steps it with the time [s], never decreasing, at least every millisecond. Requests go out at
/// `period`, and each gets one reply. Safety rules:
///  - the force is exactly zero until kHomedInARow consecutive replies had all three homed flags, then starts softly;
///  - a flag that drops later, or a second impossible sample in a row: latched, force to zero from the next request on;
///  - no reply for kForceHold at the time of a request: force to zero; for kHold: the sample becomes invalid too;
///  - no new command for kCommandHold (its sender is dead): force to zero.
/// The force returns at the slew limit after a short gap, softly after a longer one. It falls at the slew limit of the
/// rating: from 4 N at 1 N/ms, zero is sent 5 ms after the last good reply.
/// Thread: one, its own in operation; nothing is allocated after construction.
class FalconLink {
 public:
  /// `transport` and the bytes of `firmware` must outlive the link; empty: no firmware to load.
  FalconLink(FalconTransport& transport, std::span<const std::uint8_t> firmware, const LinkSettings& settings);

  /// Starts up the device.
  void open(double now) noexcept;
  void step(double now, const LinkCommand& command) noexcept;
  /// Leaves a latched fault and asks for homing again; the only way out of a latched fault.
  void rearm() noexcept;
  /// Takes the force to zero from the next request on, regardless of commands.
  void release() noexcept;

  const LinkSample& sample() const noexcept { return sample_; }
  LinkStatus status() const noexcept;

  static constexpr int kHomedInARow = 10;
  static constexpr double kHold = 2e-3;          ///< max age of a sample [s]
  static constexpr double kForceHold = 1e-3;     ///< max age of the last reply at a request; in effect 1 to 2 ms [s]
  static constexpr double kCommandHold = 10e-3;  ///< max age of a command [s]
  static constexpr double kLateReply = 2e-3;     ///< max wait for the reply to a request [s]

 private:
  void bringUp(double now) noexcept;
  void receive(double now) noexcept;
  void take(const Reply& reply, double asked, double now) noexcept;
  void request(double now, const LinkCommand& command) noexcept;
  Counts countsFor(double now, const LinkCommand& command, ForceGate& forces) const noexcept;
  void forgetLate(double now) noexcept;
  double askedAt() noexcept;
  void operate() noexcept;
  void latch(LinkFault fault) noexcept;
  void die(LinkFault fault) noexcept;

  FalconTransport& transport_;
  LinkSettings settings_;
  FalconLoader loader_;
  PacketParser parser_;
  SampleGate samples_;
  ForceGate forces_;
  LinkState state_ = LinkState::kClosed;
  LinkFault fault_ = LinkFault::kNone;
  LinkSample sample_;
  std::uint8_t homed_ = 0;
  int homed_in_a_row_ = 0;
  double arrived_ = 0;  // time of the last good sample
  double next_request_ = 0, last_request_ = 0;
  // send times of requests without a reply: at most two, oldest first
  std::array<double, 2> asked_{};
  std::size_t waiting_ = 0;
  std::uint64_t requests_ = 0, replies_ = 0;
  std::uint64_t replies_before_ = 0;  // value at the last request
};

}  // namespace presa::falcon
