#pragma once
#include <cmath>
#include <functional>
#include <memory>
#include <numeric>
#include <vector>

#include "devices/falcon_model/falcon_model.h"
#include "devices/falcon_model/model_transport.h"
#include "devices/novint_falcon/link.h"

/// The driver's link on the model of the device, in one virtual time: the link is stepped every 0.25 ms, as by its
/// thread, and a haptic loop of 1 kHz commands force(sample).
namespace presa::falcon {

using Model = falcon_model::FalconModel;
using falcon_model::ModelSettings;

/// Synthetic, with the size and the first bytes of the real firmware.
inline std::vector<std::uint8_t> madeUpFirmware() {
  std::vector<std::uint8_t> bytes(8492);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(i * 31 + i / 256);
  bytes[0] = 0xAA, bytes[1] = 0x08, bytes[2] = bytes[3] = 0;
  return bytes;
}

inline ModelSettings withoutFirmware() {
  ModelSettings settings;
  settings.loader.firmware = madeUpFirmware();
  return settings;
}
inline ModelSettings inOperation() {
  ModelSettings settings = withoutFirmware();
  settings.has_firmware = settings.homed = true;
  return settings;
}

struct ModelBench {
  static constexpr double kForce = 8, kForceRate = 1000;

  explicit ModelBench(const ModelSettings& settings = inOperation(), std::vector<std::uint8_t> file = madeUpFirmware())
      : model(settings), firmware(std::move(file)) {
    model.limits({.force = kForce, .force_rate = kForceRate});
    connect();
  }
  /// Connects like a newly started program.
  void connect() {
    link.reset();
    transport.reset();
    transport = falcon_model::ModelTransport::open(model);
    link = std::make_unique<FalconLink>(*transport, firmware,
                                        LinkSettings{.rating = {.force = 8, .force_rate = kForceRate}});
    link->open(now());
  }

  double now() const { return static_cast<double>(quarters) * 0.25e-3; }
  void step() {
    ++quarters;
    if (quarters % 4 == 0) {
      ++ticks;
      if (force) command = {force(link->sample()), now()};
    }
    link->step(now(), command);
    model.advance(now());
  }
  void run(double seconds) {
    for (const auto until = quarters + std::lround(seconds / 0.25e-3); quarters < until;) step();
  }
  /// Runs until the link is in that state; false: not within that time.
  bool reach(LinkState state, double seconds) {
    for (const auto until = quarters + std::lround(seconds / 0.25e-3); quarters < until;) {
      step();
      if (link->status().state == state) return true;
    }
    return false;
  }
  void handAt(const Vec3& p_D) {
    model.grip().hand([p_D](double) { return p_D; });
  }
  /// Pulls the grip out and pushes it in.
  void home() {
    const double begin = now();
    model.grip().hand([begin](double time) -> Vec3 {
      const double s = std::clamp((time - begin) / 0.4, 0.0, 2.0);
      return {0, 0, s < 1 ? 0.125 + 0.045 * s : 0.170 - 0.050 * (s - 1)};
    });
  }
  /// Brings the link into operation, past the soft start, under this force.
  void operate(const Vec3& f_D) {
    force = [f_D](const LinkSample&) { return f_D; };
    reach(LinkState::kOperating, 2);
    run(0.7);
  }
  const Vec3& felt() const { return model.received().meant_D; }

  Model model;
  std::vector<std::uint8_t> firmware;
  std::unique_ptr<falcon_model::ModelTransport> transport;
  std::unique_ptr<FalconLink> link;
  std::function<Vec3(const LinkSample&)> force;
  LinkCommand command;
  std::int64_t quarters = 0, ticks = 0;
};

}  // namespace presa::falcon
