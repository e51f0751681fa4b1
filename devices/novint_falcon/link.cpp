#include "devices/novint_falcon/link.h"

#include <algorithm>

namespace presa::falcon {
namespace {

constexpr double kTick = 1e-6;  // [s] tolerance for equal times

std::uint8_t lightOf(LinkState state) noexcept {
  switch (state) {
    case LinkState::kOperating:
      return kGreen;
    case LinkState::kHoming:
      return kBlue;
    default:
      return kRed;
  }
}

}  // namespace

FalconLink::FalconLink(FalconTransport& transport, std::span<const std::uint8_t> firmware, const LinkSettings& settings)
    : transport_(transport),
      settings_(settings),
      loader_(transport, firmware),
      samples_(settings.max_speed, settings.period),
      forces_(settings.rating) {}

void FalconLink::open(double now) noexcept {
  state_ = LinkState::kStarting;
  fault_ = LinkFault::kNone;
  sample_ = {};
  loader_.start(now);
}

void FalconLink::rearm() noexcept {
  if (state_ != LinkState::kLatched) return;
  state_ = LinkState::kHoming;
  fault_ = LinkFault::kNone;
  homed_in_a_row_ = 0;
  sample_.lost = false;
}

void FalconLink::release() noexcept {
  if (state_ == LinkState::kDead || state_ == LinkState::kClosed) return;
  state_ = state_ == LinkState::kStarting ? LinkState::kDead : LinkState::kReleased;  // no requests to the boot loader
  sample_.valid = false;
}

void FalconLink::step(double now, const LinkCommand& command) noexcept {
  if (state_ == LinkState::kClosed || state_ == LinkState::kDead) return;
  if (transport_.lost()) return die(LinkFault::kLost);
  if (state_ == LinkState::kStarting) return bringUp(now);
  receive(now);
  forgetLate(now);
  if (sample_.valid && now - arrived_ > kHold + kTick) sample_.valid = false;
  if (now >= next_request_ - kTick && waiting_ < asked_.size()) request(now, command);
}

void FalconLink::bringUp(double now) noexcept {
  switch (loader_.step(now)) {
    case FalconLoader::Result::kBusy:
      return;
    case FalconLoader::Result::kFailed:
      return die(loader_.fault());
    case FalconLoader::Result::kReady:
      break;
  }
  state_ = LinkState::kHoming;
  homed_in_a_row_ = 0;
  parser_.reset();
  waiting_ = 0;
  next_request_ = last_request_ = now;
}

void FalconLink::receive(double now) noexcept {
  std::array<std::uint8_t, 64> bytes;
  for (std::size_t read = bytes.size(); read == bytes.size();) {
    read = transport_.read(bytes, now);
    parser_.push({bytes.data(), std::min(read, bytes.size())});
  }
  for (Reply reply; parser_.next(reply);) {
    ++replies_;
    take(reply, waiting_ > 0 ? askedAt() : now, now);
  }
}

void FalconLink::take(const Reply& reply, double asked, double now) noexcept {
  homed_ = reply.homed;
  sample_.buttons = reply.buttons;
  const bool homed = reply.homed == kAllHomed;
  if (state_ == LinkState::kHoming) {
    homed_in_a_row_ = homed ? homed_in_a_row_ + 1 : 0;
    if (homed_in_a_row_ >= kHomedInARow) operate();
  }
  if (state_ != LinkState::kOperating) return;
  if (!homed) return latch(LinkFault::kHomingLost);
  switch (samples_.take(reply.encoders, asked)) {
    case SampleGate::Verdict::kLatched:
      return latch(LinkFault::kBadSamples);
    case SampleGate::Verdict::kRejected:
      return;  // the previous sample stays valid for up to kHold
    case SampleGate::Verdict::kGood:
      break;
  }
  sample_.p_DH = samples_.position();
  sample_.v_DH = samples_.velocity();
  sample_.valid = true;
  arrived_ = now;
}

void FalconLink::operate() noexcept {
  state_ = LinkState::kOperating;
  samples_.reset();
  forces_.soften();
}

void FalconLink::latch(LinkFault fault) noexcept {
  state_ = LinkState::kLatched;
  fault_ = fault;
  sample_.valid = false;
  sample_.lost = true;
}

void FalconLink::die(LinkFault fault) noexcept {
  latch(fault);
  state_ = LinkState::kDead;
}

void FalconLink::request(double now, const LinkCommand& command) noexcept {
  if (replies_ == replies_before_) homed_in_a_row_ = 0;  // a gap ends the row
  ForceGate forces = forces_;
  const Request wanted{.force = countsFor(now, command, forces), .light = lightOf(state_), .homing = true};
  if (!transport_.write(encode(wanted), now)) return;  // the previous request is still in transit: retry later
  forces_ = forces;                                    // commit the ramp only for a request that was sent
  ++requests_;
  replies_before_ = replies_;
  asked_[waiting_++] = now;
  last_request_ = now;
  next_request_ += settings_.period;
  if (next_request_ <= now) next_request_ = now + settings_.period;
}

Counts FalconLink::countsFor(double now, const LinkCommand& command, ForceGate& forces) const noexcept {
  const bool operating = state_ == LinkState::kOperating && !samples_.empty();
  if (!operating && forces.quiet()) return {};
  const bool fresh =
      operating && sample_.valid && now - arrived_ <= kForceHold + kTick && now - command.time <= kCommandHold + kTick;
  // limit the slope to one period, however late this request is
  const Vec3 force = forces.step(command.f_H_D, fresh, std::min(now - last_request_, settings_.period));
  if (forces.quiet()) return {};
  const auto counts = motorCounts(force, sample_.p_DH, settings_.max_counts, settings_.counts_per_torque);
  if (!counts) forces.cut();
  return counts.value_or(Counts{});
}

void FalconLink::forgetLate(double now) noexcept {
  while (waiting_ > 0 && now - asked_[0] > kLateReply - kTick) samples_.unsettle(askedAt(), now);
}

double FalconLink::askedAt() noexcept {
  const double oldest = asked_[0];
  asked_[0] = asked_[1];
  --waiting_;
  return oldest;
}

LinkStatus FalconLink::status() const noexcept {
  return {.state = state_,
          .fault = fault_,
          .load = loader_.report(),
          .homed = homed_,
          .quiet = forces_.quiet(),
          .loading = state_ == LinkState::kStarting && loader_.loading(),
          .requests = requests_,
          .replies = replies_,
          .dropped = parser_.dropped(),
          .rejected = samples_.rejected()};
}

}  // namespace presa::falcon
