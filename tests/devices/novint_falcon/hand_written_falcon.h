#pragma once
#include <algorithm>
#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "devices/novint_falcon/packet.h"
#include "devices/novint_falcon/transport.h"

namespace presa::falcon {

using Bytes = std::vector<std::uint8_t>;

/// A reply built nibble by nibble, independently of the code under test.
inline Bytes replyOf(const Counts& encoders, int status, int unspecified = 0x41) {
  Bytes bytes{'<'};
  for (const std::int32_t count : encoders) {
    for (int nibble = 0, rest = count & 0xFFFF; nibble < 4; ++nibble, rest /= 16)
      bytes.push_back(static_cast<std::uint8_t>('A' + rest % 16));
  }
  bytes.push_back(static_cast<std::uint8_t>(status));
  bytes.push_back(static_cast<std::uint8_t>(unspecified));
  bytes.push_back('>');
  return bytes;
}

/// A scripted device: answers byte by byte as the protocol description says, with faults chosen by the test. It has no
/// mechanics and checks nothing; it records what it receives.
class HandWrittenFalcon final : public FalconTransport {
 public:
  struct Sent {
    double time = 0;
    Counts force{};
    int light_and_homing = 0;
    bool well_formed = false;
    bool zero() const { return force == Counts{}; }
  };

  // properties
  bool loaded = true;       ///< its firmware is running
  std::size_t expects = 0;  ///< number of firmware bytes after which it runs
  Counts encoders{};
  int homed = 7, buttons = 0;
  double latency = 0.4e-3;  ///< [s] from a request to its reply

  // faults
  bool unplugged = false, refuses = false, busy = false;
  int replies_to_swallow = 0;
  std::function<Bytes(Bytes)> damage;  ///< applied to each reply
  int deaf_greetings = 0;
  bool zero_first = false, deaf_to_speed = false, wont_run = false;
  std::function<Bytes(int attempt, std::size_t at, Bytes)> garble;  ///< applied to each echo

  // records
  std::vector<Sent> sent;
  std::vector<Control> controls;
  Bytes firmware;
  std::vector<std::size_t> chunks;
  int attempts = 0, greetings = 0;

  bool control(Control control, double) noexcept override {
    if (unplugged || refuses) return false;
    controls.push_back(control);
    if (control == Control::kPurgeReceive) pending_.clear();
    if (control == Control::kBaud9600 || control == Control::kBaud140000 || control == Control::kBaud1500000)
      baud_ = control;
    if (control == Control::kBaud9600) in_loader_ = marked_ = false;
    return true;
  }

  bool write(std::span<const std::uint8_t> bytes, double now) noexcept override {
    if (unplugged || busy || bytes.size() > kMaxWrite) return false;
    const Bytes copy(bytes.begin(), bytes.end());
    if (baud_ == Control::kBaud1500000) onPacket(copy, now);
    if (baud_ == Control::kBaud9600) onGreeting(copy, now);
    if (baud_ == Control::kBaud140000) onLoad(copy, now);
    return true;
  }

  std::size_t read(std::span<std::uint8_t> buffer, double now) noexcept override {
    std::size_t count = 0;
    while (count < buffer.size() && !pending_.empty() && pending_.front().first <= now + 1e-9) {
      buffer[count++] = pending_.front().second;
      pending_.pop_front();
    }
    return count;
  }

  bool lost() const noexcept override { return unplugged; }

  void queue(const Bytes& bytes, double at) {
    for (const std::uint8_t byte : bytes) pending_.emplace_back(at, byte);
  }

 private:
  static int valueAt(const Bytes& bytes, std::size_t at) {
    int value = 0;
    for (std::size_t n = 4; n-- > 0;) value = 16 * value + bytes[at + n] - 'A';
    return value >= 32768 ? value - 65536 : value;
  }

  void onPacket(const Bytes& bytes, double now) {
    Sent packet{.time = now};
    packet.well_formed = bytes.size() == 16 && bytes[0] == '<' && bytes[15] == '>' && bytes[14] == 'A' &&
                         std::all_of(bytes.begin() + 1, bytes.begin() + 14, [](int b) { return b >= 'A' && b <= 'P'; });
    if (packet.well_formed) {
      packet.force = {valueAt(bytes, 1), valueAt(bytes, 5), valueAt(bytes, 9)};
      packet.light_and_homing = bytes[13] - 'A';
    }
    sent.push_back(packet);
    if (!loaded) return;
    if (replies_to_swallow > 0) {
      --replies_to_swallow;
      return;
    }
    const Bytes reply = replyOf(encoders, 0x41 + buttons + 16 * homed);
    queue(damage ? damage(reply) : reply, now + latency);
  }

  void onGreeting(const Bytes& bytes, double now) {
    if (bytes != Bytes{0x0A, 0x43, 0x0D} || loaded) return;
    if (greetings++ < deaf_greetings) return;
    queue(zero_first ? Bytes{0x00, 0x0A, 0x44, 0x2C, 0x0D} : Bytes{0x0A, 0x44, 0x2C, 0x0D}, now + 0.02);
    in_loader_ = true;
  }

  void onLoad(const Bytes& bytes, double now) {
    if (!in_loader_) return;
    if (!marked_) {
      if (bytes != Bytes{0x41} || deaf_to_speed) return;
      marked_ = true;
      ++attempts;
      firmware.clear();
      chunks.clear();
      return queue(bytes, now + 0.005);
    }
    const std::size_t at = firmware.size();
    chunks.push_back(bytes.size());
    firmware.insert(firmware.end(), bytes.begin(), bytes.end());
    queue(garble ? garble(attempts, at, bytes) : bytes, now + 0.005);
    loaded = firmware.size() >= expects && !wont_run;
  }

  Control baud_ = Control::kBaud9600;
  bool in_loader_ = false, marked_ = false;
  std::deque<std::pair<double, std::uint8_t>> pending_;
};

}  // namespace presa::falcon
