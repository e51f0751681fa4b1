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
  DeviceRating rating = kRating;                ///< of the gate; a test may have another
  double counts_per_torque = kCountsPerTorque;  ///< [1/(N m)]
  int max_counts = kMaxCounts;
};

/// What is wanted of the grip, and since when.
struct LinkCommand {
  Vec3 f_H_D = Vec3::Zero();                               ///< force on the grip [N]
  double time = -std::numeric_limits<double>::infinity();  ///< when it was made, on the link's clock [s]
};

/// What is known of the grip, in the device's frame D (kinematics.h).
struct LinkSample {
  Vec3 p_DH = Vec3::Zero(), v_DH = Vec3::Zero();  ///< [m], [m/s]
  std::uint8_t buttons = 0;                       ///< Button bits
  bool valid = false;                             ///< homed, in operation, and young enough
  bool lost = false;                              ///< a latched fault: nothing comes before a re-arm
};

/// What is known of the link itself.
struct LinkStatus {
  LinkState state = LinkState::kClosed;
  LinkFault fault = LinkFault::kNone;
  LoadReport load;
  std::uint8_t homed = 0;  ///< of the last reply
  bool quiet = true;       ///< zero force was sent last
  bool loading = false;    ///< firmware is on its way
  std::uint64_t requests = 0, replies = 0;
  std::uint64_t dropped = 0;   ///< bytes that were part of no reply
  std::uint64_t rejected = 0;  ///< samples that no hand can have moved to
};

/// A Novint Falcon from the first control request to the last zero force, over any transport. It has no clock: whoever steps
/// it says what time it is [s], never backwards, every millisecond or oftener. Requests go out at `period`, each answered by
/// one reply; what keeps the hand safe:
///  - force is exactly zero until all three homed flags came in kHomedInARow replies, and starts softly then;
///  - a flag that drops later, or a second impossible sample in a row: latched, and from the next request on down to zero;
///  - no reply for kForceHold at the time of a request: down to zero; for kHold: the sample is invalid too;
///  - no new command for kCommandHold (its maker is dead): down to zero.
/// What comes back after a short gap rises as fast, after a longer one softly. Down is as fast as the rating allows and no faster: from 4 N at 1 N/ms zero is sent 5 ms after the last good reply.
/// Thread: one, its own in operation; nothing is allocated after construction.
class FalconLink {
 public:
  /// `transport` and the bytes of `firmware` outlive the link; empty: none to load.
  FalconLink(FalconTransport& transport, std::span<const std::uint8_t> firmware, const LinkSettings& settings);

  /// Begins to bring the device up.
  void open(double now) noexcept;
  void step(double now, const LinkCommand& command) noexcept;
  /// Out of a latched fault: asks for homing again. Nothing else leads out of one.
  void rearm() noexcept;
  /// From the next request on down to zero force, whatever is commanded.
  void release() noexcept;

  const LinkSample& sample() const noexcept { return sample_; }
  LinkStatus status() const noexcept;

  static constexpr int kHomedInARow = 10;
  static constexpr double kHold = 2e-3;       ///< of a sample [s]
  static constexpr double kForceHold = 1e-3;  ///< of a force: between requests it grows by a period, so 1 to 2 ms [s]
  static constexpr double kCommandHold = 10e-3;  ///< of a command [s]
  static constexpr double kLateReply = 2e-3;     ///< a request older than this is not waited for any more [s]

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
  double arrived_ = 0;  // of the last good sample
  double next_request_ = 0, last_request_ = 0;
  // when the requests were sent that have no reply yet: at most two, oldest first
  std::array<double, 2> asked_{};
  std::size_t waiting_ = 0;
  std::uint64_t requests_ = 0, replies_ = 0;
  std::uint64_t replies_before_ = 0;  // at the last request
};

}  // namespace presa::falcon
