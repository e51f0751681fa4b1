#include "experiments/faults/falcon_finger.h"

#include <cmath>
#include <numbers>

#include "devices/novint_falcon/finger.h"

namespace presa::faults {
namespace {

const Vec3 kMiddle_D(0, 0, 0.120);               // centre of the workspace, where the device is strongest [m]
const Vec3 kMiddle_W(0.046, 0, 0.075);           // the same point in the grasp, for the index [m]
constexpr double kWire = 0.2e-3;                 // longer than a request takes, shorter than a step of the link [s]
constexpr double kForce = 8, kForceRate = 1000;  // of the scene [N], [N/s]

Pose standing(double side) {
  const double half = std::numbers::pi / 4;
  Pose X_WD;
  X_WD.q = Quat(std::cos(half), 0, -side * std::sin(half), 0);  // device z axis towards the object
  X_WD.p = Vec3(side * kMiddle_W.x(), 0, kMiddle_W.z()) - X_WD.q * kMiddle_D;
  return X_WD;
}

falcon_model::ModelSettings ready(std::uint64_t seed) {
  falcon_model::ModelSettings settings;
  settings.seed = seed;
  settings.has_firmware = settings.homed = true;
  settings.loader.firmware = madeUpFirmware();
  const HandImpedance hand;
  settings.grip.mass = hand.mass;
  settings.grip.hand_stiffness = hand.stiffness;
  settings.grip.hand_damping = hand.damping;
  return settings;
}

}  // namespace

std::vector<std::uint8_t> madeUpFirmware() {
  std::vector<std::uint8_t> bytes(8492);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(i * 31 + i / 256);
  bytes[0] = 0xAA, bytes[1] = 0x08, bytes[2] = bytes[3] = 0;
  return bytes;
}

FalconFinger::FalconFinger(const Hold& hold, double side, std::uint64_t seed, Transport& transport)
    : transport_(transport), X_WD_(standing(side)), model_(ready(seed)), firmware_(madeUpFirmware()) {
  model_.limits({.force = kForce, .force_rate = kForceRate});
  model_.grip().hand([&hold, side, X_WD = X_WD_](double time) {
    return X_WD.inverseTimes(handAt(hold, {}, side, time - kPrelude).p_WH);
  });
  usb_ = falcon_model::ModelTransport::open(model_);
  link_ = std::make_unique<falcon::FalconLink>(*usb_, firmware_,
                                               falcon::LinkSettings{.rating = {.force = 8, .force_rate = kForceRate}});
  link_->open(0);
  stepUntil(kPrelude - kStep);
}

void FalconFinger::stepUntil(double time) noexcept {
  while (now() + kStep < time + kStep / 2) {
    ++steps_;
    link_->step(now(), command_);
    model_.advance(now());
    if (at_step) at_step();
  }
}

FingerInput FalconFinger::read(const Tick& tick) noexcept {
  stepUntil(timeOf(tick.time));
  model_.advance(now() + kWire);  // let the latest request arrive first
  transport_.force = model_.plugged() ? Vec3(X_WD_.q * model_.received().meant_D) : Vec3(Vec3::Zero());
  transport_.largest_step = model_.watch().largestStep();
  transport_.energy = model_.grip().energy();
  return falcon::fingerOf(link_->sample(), X_WD_, 1);
}

void FalconFinger::write(const Wrench& F_H_W, const Tick& tick) noexcept {
  command_ = {X_WD_.q.conjugate() * F_H_W.f, timeOf(tick.time)};
}

void FalconFinger::rearm() noexcept {
  link_->rearm();
  model_.forgive();
}

}  // namespace presa::faults
