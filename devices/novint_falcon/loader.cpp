#include "devices/novint_falcon/loader.h"

#include <algorithm>

namespace presa::falcon {
namespace {

constexpr std::array<std::uint8_t, 3> kGreeting{0x0A, 0x43, 0x0D};
constexpr std::array<std::uint8_t, 4> kGreeted{0x0A, 0x44, 0x2C, 0x0D};
constexpr std::array<std::uint8_t, 1> kSpeedMark{0x41};

// [s] to wait for an answer: transmission, latency timer, and a busy computer
constexpr double kProbeWait = 0.05;
constexpr double kGreetingWait = 0.05;
constexpr double kEchoWait = 0.25;

}  // namespace

void FalconLoader::start(double now) noexcept {
  fault_ = LinkFault::kNone;
  report_ = {};
  loaded_ = false;
  if (!controls({Control::kPurgeReceive, Control::kPurgeTransmit}, now)) return;
  normalMode(now);
}

FalconLoader::Result FalconLoader::step(double now) noexcept {
  if (phase_ != Phase::kDone && transport_.lost()) fail(LinkFault::kLost);
  if (unsent_size_ > 0 && phase_ != Phase::kDone && transport_.write({unsent_.data(), unsent_size_}, now))
    unsent_size_ = 0;
  switch (phase_) {
    case Phase::kProbe:
      onProbe(now);
      break;
    case Phase::kGreeting:
      onGreeting(now);
      break;
    case Phase::kSpeed:
      onSpeed(now);
      break;
    case Phase::kEcho:
      onEcho(now);
      break;
    case Phase::kIdle:
    case Phase::kDone:
      break;
  }
  if (phase_ != Phase::kDone) return Result::kBusy;
  return fault_ == LinkFault::kNone ? Result::kReady : Result::kFailed;
}

void FalconLoader::normalMode(double now) noexcept {
  if (!controls({Control::kLatency1ms, Control::kBaud1500000, Control::kPurgeReceive, Control::kPurgeTransmit}, now))
    return;
  parser_.reset();
  tries_ = 0;
  probe(now);
}

void FalconLoader::probe(double now) noexcept {
  ++tries_;
  const Packet packet = encode({.light = kRed});
  await(Phase::kProbe, now + kProbeWait);
  send(packet, now);
}

void FalconLoader::onProbe(double now) noexcept {
  receive(now);
  parser_.push({received_.data(), received_size_});
  received_size_ = 0;
  if (Reply reply; parser_.next(reply)) {
    phase_ = Phase::kDone;
    return;
  }
  if (now < until_) return;
  if (tries_ < kMaxProbes) return probe(now);
  if (loaded_) return failAttempt(LinkFault::kFirmwareSilent, now);
  if (firmware_.empty()) return fail(LinkFault::kNoFirmware);
  tries_ = 0;
  greet(now);
}

void FalconLoader::greet(double now) noexcept {
  ++tries_;
  if (!controls(
          {Control::kPurgeReceive, Control::kPurgeTransmit, Control::kLatency16ms, Control::kBaud9600,
           Control::kEightBitsNoParity, Control::kNoFlowControl, Control::kRtsLow, Control::kDtrLow, Control::kDtrHigh},
          now))
    return;
  await(Phase::kGreeting, now + kGreetingWait);
  send(kGreeting, now);
}

void FalconLoader::onGreeting(double now) noexcept {
  receive(now);
  const std::size_t skip = received_size_ > 0 && received_[0] == 0 ? 1 : 0;  // sometimes a 00 comes first
  if (received_size_ >= skip + kGreeted.size()) {
    if (std::equal(kGreeted.begin(), kGreeted.end(), received_.begin() + static_cast<std::ptrdiff_t>(skip)))
      return changeSpeed(now);
  }
  if (now < until_) return;
  if (tries_ < kMaxGreetings) return greet(now);
  fail(LinkFault::kNoLoader);
}

void FalconLoader::changeSpeed(double now) noexcept {
  if (!controls({Control::kDtrLow, Control::kBaud140000}, now)) return;
  await(Phase::kSpeed, now + kEchoWait);
  send(kSpeedMark, now);
}

void FalconLoader::onSpeed(double now) noexcept {
  receive(now);
  if (received_size_ > 0 && received_[0] == kSpeedMark[0]) {
    sent_ = 0;
    report_.bytes = 0;
    return sendChunk(now);
  }
  if (received_size_ > 0 || now >= until_) failAttempt(LinkFault::kEchoMissing, now);
}

void FalconLoader::sendChunk(double now) noexcept {
  const auto chunk = firmware_.subspan(sent_, std::min(kChunk, firmware_.size() - sent_));
  await(Phase::kEcho, now + kEchoWait);
  send(chunk, now);
  sent_ += chunk.size();
}

void FalconLoader::onEcho(double now) noexcept {
  receive(now);
  for (std::size_t i = 0; i < received_size_; ++i) {
    // surplus bytes are an error too
    const bool owed = report_.bytes < sent_;
    if (!owed || received_[i] != firmware_[report_.bytes]) {
      report_.expected = owed ? firmware_[report_.bytes] : 0;
      report_.found = received_[i];
      return failAttempt(LinkFault::kEchoMismatch, now);
    }
    ++report_.bytes;
  }
  received_size_ = 0;
  if (report_.bytes == firmware_.size()) {
    loaded_ = true;
    return normalMode(now);
  }
  if (report_.bytes == sent_) return sendChunk(now);
  if (now >= until_) failAttempt(LinkFault::kEchoMissing, now);
}

bool FalconLoader::controls(std::initializer_list<Control> sequence, double now) noexcept {
  for (const Control control : sequence) {
    if (transport_.control(control, now)) continue;
    fail(transport_.lost() ? LinkFault::kLost : LinkFault::kControlRefused);
    return false;
  }
  return true;
}

void FalconLoader::await(Phase phase, double until) noexcept {
  phase_ = phase;
  until_ = until;
}

void FalconLoader::send(std::span<const std::uint8_t> bytes, double now) noexcept {
  received_size_ = 0;
  unsent_size_ = 0;
  if (transport_.write(bytes, now)) return;
  std::copy(bytes.begin(), bytes.end(), unsent_.begin());
  unsent_size_ = bytes.size();
}

void FalconLoader::receive(double now) noexcept {
  const std::size_t read = transport_.read({received_.data() + received_size_, received_.size() - received_size_}, now);
  received_size_ += std::min(read, received_.size() - received_size_);
}

void FalconLoader::failAttempt(LinkFault why, double now) noexcept {
  ++report_.attempts;
  if (report_.attempts >= kMaxAttempts) return fail(why);
  loaded_ = false;
  tries_ = 0;
  greet(now);
}

void FalconLoader::fail(LinkFault why) noexcept {
  fault_ = why;
  phase_ = Phase::kDone;
}

}  // namespace presa::falcon
