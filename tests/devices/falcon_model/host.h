#pragma once
#include <initializer_list>
#include <memory>
#include <numeric>
#include <optional>
#include <vector>

#include "devices/falcon_model/falcon_model.h"
#include "devices/falcon_model/model_transport.h"

/// A minimal host for tests: it does one step per call.
namespace presa::falcon_model::test {

using falcon::Control;

/// Synthetic; starts like the real firmware. Several chunks long, not a multiple of a chunk.
inline std::vector<std::uint8_t> firmware() {
  std::vector<std::uint8_t> bytes(1000);
  std::iota(bytes.begin(), bytes.end(), std::uint8_t{0});
  bytes[0] = 0xAA, bytes[1] = 0x08, bytes[2] = bytes[3] = 0;
  return bytes;
}

inline ModelSettings running(bool homed = true) {
  ModelSettings settings;
  settings.has_firmware = true;
  settings.homed = homed;
  settings.loader.firmware = firmware();
  return settings;
}

struct Host {
  explicit Host(FalconModel& falcon) : model(falcon), transport(ModelTransport::open(falcon)) {}

  bool control(std::initializer_list<Control> controls) {
    bool done = true;
    for (const Control control : controls) done = transport->control(control, now) && done;
    return done;
  }
  void toOperation() {
    control({Control::kLatency1ms, Control::kBaud1500000, Control::kPurgeReceive, Control::kPurgeTransmit});
  }
  bool write(std::vector<std::uint8_t> bytes) { return transport->write(bytes, now); }
  /// All bytes that arrive within this time.
  std::vector<std::uint8_t> readFor(double seconds) {
    std::vector<std::uint8_t> all;
    for (const double until = now + seconds; now < until - 1e-9;) {
      now += 0.25e-3;
      std::uint8_t buffer[64];
      const std::size_t count = transport->read(buffer, now);
      all.insert(all.end(), buffer, buffer + count);
    }
    return all;
  }
  /// Greeting and the load command 41; true: the device waits for firmware.
  bool greet() {
    control({Control::kPurgeReceive, Control::kPurgeTransmit, Control::kLatency16ms, Control::kBaud9600,
             Control::kEightBitsNoParity, Control::kNoFlowControl, Control::kRtsLow, Control::kDtrLow,
             Control::kDtrHigh});
    write({0x0A, 0x43, 0x0D});
    answer = readFor(0.1);
    control({Control::kDtrLow, Control::kBaud140000});
    write({0x41});
    return readFor(0.1) == std::vector<std::uint8_t>{0x41};
  }
  /// Uploads bytes; returns the echo.
  std::vector<std::uint8_t> upload(const std::vector<std::uint8_t>& bytes) {
    std::vector<std::uint8_t> echo;
    for (std::size_t i = 0; i < bytes.size(); i += 62) {
      write({bytes.begin() + static_cast<std::ptrdiff_t>(i),
             bytes.begin() + static_cast<std::ptrdiff_t>(std::min(i + 62, bytes.size()))});
      const auto part = readFor(0.05);
      echo.insert(echo.end(), part.begin(), part.end());
    }
    return echo;
  }
  /// One cycle of a millisecond: a request at its start, the newest reply at its end.
  std::optional<Status> cycle(const Request& request) {
    const Frame frame = frameOf(request);
    write({frame.begin(), frame.end()});
    const auto bytes = readFor(1e-3);
    pending.insert(pending.end(), bytes.begin(), bytes.end());
    std::optional<Status> newest;
    for (; pending.size() >= kFrame; pending.erase(pending.begin(), pending.begin() + kFrame)) {
      last = newest = statusOf(std::span(pending).first(kFrame));
    }
    return newest;
  }
  void cycles(const Request& request, int count) {
    for (int i = 0; i < count; ++i) cycle(request);
  }

  FalconModel& model;
  std::unique_ptr<ModelTransport> transport;
  double now = 0;
  std::vector<std::uint8_t> answer;  // to the greeting
  std::vector<std::uint8_t> pending;
  std::optional<Status> last;
};

}  // namespace presa::falcon_model::test
