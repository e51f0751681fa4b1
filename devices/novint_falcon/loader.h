#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "devices/novint_falcon/link_state.h"
#include "devices/novint_falcon/packet.h"
#include "devices/novint_falcon/transport.h"

namespace presa::falcon {

/// Starts up a device: asks whether its firmware runs (it persists until power-off), and loads it otherwise. The echo
/// of every byte is the only checksum. Uploads sometimes fail, so there are up to ten attempts. No clock of its own:
/// call `step` about every millisecond with a time that never decreases.
class FalconLoader {
 public:
  enum class Result : std::uint8_t { kBusy, kReady, kFailed };

  /// Both must outlive the loader. `firmware` may be empty: then the loader only asks for running firmware.
  FalconLoader(FalconTransport& transport, std::span<const std::uint8_t> firmware)
      : transport_(transport), firmware_(firmware) {}

  void start(double now) noexcept;
  Result step(double now) noexcept;

  LinkFault fault() const noexcept { return fault_; }
  const LoadReport& report() const noexcept { return report_; }
  bool loading() const noexcept { return phase_ == Phase::kEcho; }

  static constexpr int kMaxAttempts = 10;
  static constexpr int kMaxProbes = 10;
  static constexpr int kMaxGreetings = 100;
  static constexpr std::size_t kChunk = 62;  ///< payload of a 64-byte USB packet: the converter uses two bytes

 private:
  enum class Phase : std::uint8_t { kIdle, kProbe, kGreeting, kSpeed, kEcho, kDone };

  bool controls(std::initializer_list<Control> sequence, double now) noexcept;
  void normalMode(double now) noexcept;
  void probe(double now) noexcept;
  void greet(double now) noexcept;
  void changeSpeed(double now) noexcept;
  void sendChunk(double now) noexcept;

  void onProbe(double now) noexcept;
  void onGreeting(double now) noexcept;
  void onSpeed(double now) noexcept;
  void onEcho(double now) noexcept;

  void await(Phase phase, double until) noexcept;
  void send(std::span<const std::uint8_t> bytes, double now) noexcept;
  /// Reads the bytes that arrived since the last send into received_.
  void receive(double now) noexcept;
  void failAttempt(LinkFault why, double now) noexcept;
  void fail(LinkFault why) noexcept;

  FalconTransport& transport_;
  std::span<const std::uint8_t> firmware_;
  Phase phase_ = Phase::kIdle;
  LinkFault fault_ = LinkFault::kNone;
  LoadReport report_;
  double until_ = 0;
  int tries_ = 0;  // of the current phase
  bool loaded_ = false;
  std::size_t sent_ = 0;  // bytes of the firmware

  std::array<std::uint8_t, kMaxWrite> unsent_{};  // waits until the transport accepts it
  std::size_t unsent_size_ = 0;
  std::array<std::uint8_t, 512> received_{};
  std::size_t received_size_ = 0;
  PacketParser parser_;
};

}  // namespace presa::falcon
