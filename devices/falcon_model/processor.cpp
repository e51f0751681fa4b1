#include "devices/falcon_model/processor.h"

#include <algorithm>
#include <cmath>

namespace presa::falcon_model {
namespace {

constexpr std::uint8_t kOpen = '<', kClose = '>', kBase = 0x41;
constexpr double kReplyDelay = 20e-6;  // delay before an answer [s]

/// Decodes four nibbles, least significant first; nullopt for a byte that is no nibble.
std::optional<int> wordOf(const std::uint8_t* bytes) {
  unsigned word = 0;
  for (unsigned i = 0; i < 4; ++i) {
    const unsigned nibble = bytes[i] - unsigned{kBase};
    if (nibble > 15) return std::nullopt;
    word |= nibble << (4 * i);
  }
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(word));
}

void writeWord(int value, std::uint8_t* bytes) {
  const auto word = static_cast<std::uint16_t>(static_cast<std::int16_t>(value));
  for (unsigned i = 0; i < 4; ++i) bytes[i] = static_cast<std::uint8_t>(kBase + ((word >> (4 * i)) & 15U));
}

bool same(double a, double b) { return std::abs(a - b) < 1e-3 * b; }

}  // namespace

std::optional<Request> requestOf(const Frame& frame) {
  if (frame.front() != kOpen || frame.back() != kClose) return std::nullopt;
  Request request;
  for (const std::size_t i : {0UL, 1UL, 2UL}) {
    const std::optional<int> word = wordOf(&frame[1 + 4 * i]);
    if (!word) return std::nullopt;
    request.counts[i] = *word;
  }
  const unsigned wish = frame[13] - unsigned{kBase};
  if (wish > 15) return std::nullopt;
  request.homing = (wish & 1) != 0;
  request.green = (wish & 2) != 0;
  request.blue = (wish & 4) != 0;
  request.red = (wish & 8) != 0;
  return request;
}

Frame frameOf(const Request& request) {
  Frame frame{};
  frame.front() = kOpen;
  for (const std::size_t i : {0UL, 1UL, 2UL}) writeWord(request.counts[i], &frame[1 + 4 * i]);
  frame[13] = static_cast<std::uint8_t>(kBase + (request.homing ? 1 : 0) + (request.green ? 2 : 0) +
                                        (request.blue ? 4 : 0) + (request.red ? 8 : 0));
  frame[14] = kBase;
  frame.back() = kClose;
  return frame;
}

Frame frameOf(const Status& status, std::uint8_t meaningless) {
  Frame frame{};
  frame.front() = kOpen;
  for (const std::size_t i : {0UL, 1UL, 2UL}) writeWord(status.counters[i], &frame[1 + 4 * i]);
  frame[13] = static_cast<std::uint8_t>(kBase + (status.homed << 4U | status.buttons));
  frame[14] = meaningless;
  frame.back() = kClose;
  return frame;
}

std::optional<Status> statusOf(std::span<const std::uint8_t> bytes) {
  if (bytes.size() != kFrame || bytes.front() != kOpen || bytes.back() != kClose) return std::nullopt;
  Status status;
  for (const std::size_t i : {0UL, 1UL, 2UL}) {
    const std::optional<int> word = wordOf(&bytes[1 + 4 * i]);
    if (!word) return std::nullopt;
    status.counters[i] = *word;
  }
  const unsigned flags = bytes[13] - unsigned{kBase};
  if (flags > 127) return std::nullopt;
  status.homed = flags >> 4U;
  status.buttons = flags & 15U;
  return status;
}

void Processor::switchOn(bool has_firmware) {
  state_ = has_firmware ? State::kOperating : State::kSilent;
  filled_ = 0;
  ready_at_ = 0;
}

void Processor::linesChanged(const SerialLine& line, bool dtr_before) {
  if (dtr_before || !line.dtr() || line.rts()) return;
  state_ = State::kBootLoader;  // the running firmware is lost
  heard_.clear();
  filled_ = 0;
}

std::optional<Request> Processor::hear(const WireByte& byte, SerialLine& line) {
  const bool operates = state_ == State::kOperating;
  const bool loads = state_ == State::kUpload || (state_ == State::kGreeted && !line.dtr());
  const double rate = operates ? kOperationBaud : loads ? kUploadBaud : kLoaderBaud;
  if (!same(byte.baud, rate) || (!operates && !line.eightBitsNoParity())) {
    ++garbled_;
    return std::nullopt;
  }
  switch (state_) {
    case State::kSilent:
    case State::kHung:
      return std::nullopt;
    case State::kBootLoader:
    case State::kGreeted:
    case State::kUpload:
      if (loads) {
        load(byte, line);
      } else {
        greet(byte, line);
      }
      return std::nullopt;
    case State::kOperating:
      return byte.time < ready_at_ ? std::nullopt : assemble(byte.value);
  }
  return std::nullopt;
}

void Processor::greet(const WireByte& byte, SerialLine& line) {
  constexpr std::uint8_t kGreeting[] = {0x0A, 0x43, 0x0D}, kAnswer[] = {0x00, 0x0A, 0x44, 0x2C, 0x0D};
  heard_.push_back(byte.value);
  if (heard_.size() > std::size(kGreeting)) heard_.erase(heard_.begin());
  if (!line.dtr() || !std::ranges::equal(heard_, kGreeting)) return;
  heard_.clear();
  if (greetings_++ < loader_.deaf_greetings) return;
  state_ = State::kGreeted;
  line.processorWrites(std::span(kAnswer).subspan(loader_.zero_before ? 0 : 1), kLoaderBaud, 0,
                       byte.time + kReplyDelay);
}

void Processor::load(const WireByte& byte, SerialLine& line) {
  std::uint8_t value = byte.value, echo = value;
  if (state_ == State::kGreeted) {
    if (value != 0x41 || loader_.refuses_load) return;
    state_ = State::kUpload;
    ++uploads_;
    heard_.clear();
  } else {
    const UploadFault* fault = nullptr;
    for (const UploadFault& candidate : loader_.faults) {
      if (candidate.attempt == uploads_ - 1 && candidate.byte == heard_.size()) fault = &candidate;
    }
    if (fault != nullptr && fault->kind == UploadFault::Kind::kCorruptByte) value ^= 0x10;
    heard_.push_back(value);
    echo = fault != nullptr && fault->kind == UploadFault::Kind::kWrongEcho ? value ^ 0x04 : value;
    if (heard_.size() == loader_.firmware.size()) {
      state_ = heard_ == loader_.firmware ? State::kOperating : State::kHung;
      ready_at_ = byte.time + loader_.start;
      filled_ = 0;
    }
    if (fault != nullptr && fault->kind == UploadFault::Kind::kLostEcho) return;
  }
  line.processorWrites({&echo, 1}, kUploadBaud, 0, byte.time + kReplyDelay);
}

std::optional<Request> Processor::assemble(std::uint8_t value) {
  if (filled_ == 0 && value != kOpen) return std::nullopt;
  frame_[filled_++] = value;
  if (value == kOpen && filled_ != 1) {  // the previous frame was truncated; this starts the next one
    ++bad_frames_;
    frame_[0] = value;
    filled_ = 1;
  }
  if (filled_ < kFrame) return std::nullopt;
  filled_ = 0;
  std::optional<Request> request = requestOf(frame_);
  if (!request) ++bad_frames_;
  return request;
}

}  // namespace presa::falcon_model
