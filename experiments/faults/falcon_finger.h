#pragma once
#include <memory>
#include <string>
#include <vector>

#include "devices/falcon_model/falcon_model.h"
#include "devices/falcon_model/model_transport.h"
#include "devices/novint_falcon/link.h"
#include "experiments/faults/hold.h"

namespace presa::faults {

/// Synthetic firmware with the length and the first bytes of the real one.
std::vector<std::uint8_t> madeUpFirmware();

/// A Falcon in the hold scenario: the driver's link on the model of the device, in one virtual time. That time starts
/// kPrelude before the run, so that the device is up and the hand is at its start when the run begins. The link is
/// stepped every 0.25 ms, as by its own thread. Thread: one.
class FalconFinger final : public Device {
 public:
  /// `side`: -1 thumb, 1 index; the device's z axis lies along the axis of the grasp, towards the object. `transport`:
  /// receives the forces at the model. `transport` and `hold` must outlive the finger.
  FalconFinger(const Hold& hold, double side, std::uint64_t seed, Transport& transport);

  FingerInput read(const Tick& tick) noexcept override;
  void write(const Wrench& F_H_W, const Tick& tick) noexcept override;
  void rearm() noexcept override;
  double damping() const override { return HandImpedance{}.damping; }

  falcon_model::FalconModel& model() { return model_; }
  const falcon::FalconLink& link() const { return *link_; }
  /// Converts a time of the run to the model's time [s].
  static double timeOf(double time) { return time + kPrelude; }
  /// Called after every step of the link.
  std::function<void()> at_step;

  static constexpr double kPrelude = 0.5;  ///< [s]

 private:
  void stepUntil(double time) noexcept;
  double now() const { return static_cast<double>(steps_) * kStep; }

  static constexpr double kStep = 0.25e-3;  // period of the link thread [s]

  Transport& transport_;
  Pose X_WD_;
  falcon_model::FalconModel model_;
  std::vector<std::uint8_t> firmware_;
  std::unique_ptr<falcon_model::ModelTransport> usb_;
  std::unique_ptr<falcon::FalconLink> link_;
  falcon::LinkCommand command_;
  std::int64_t steps_ = 0;
};

}  // namespace presa::faults
