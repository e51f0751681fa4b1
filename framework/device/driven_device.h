#pragma once
#include <memory>
#include <utility>

#include "framework/device/frame_tree.h"
#include "framework/device/wrapped_device.h"

namespace presa {

/// A device in a frame that its user moves, between the driver and the FramedDevice: its samples move the frame, and a
/// wrench that answers a step of the frame does not reach the hand. After such a wrench the next ones come back within
/// the slew limits. Around no other device.
class DrivenDevice final : public WrappedDevice {
 public:
  /// Slew limits of the device [N/s], [N m/s].
  struct Slew {
    double force,  ///< [N/s]
        torque;    ///< [N m/s]
  };
  /// `role`: index into the scene's roles.
  DrivenDevice(std::unique_ptr<Device> device, std::shared_ptr<FrameTree> tree, std::size_t role, Slew slew)
      : WrappedDevice(std::move(device)), tree_(std::move(tree)), role_(role), slew_(slew) {}

  FingerInput read(const Tick& tick) noexcept override {
    const FingerInput sample = inner().read(tick);
    tree_->sampled(role_, sample, tick);
    return sample;
  }
  void write(const Wrench& F_H, const Tick& tick) noexcept override {
    const bool withheld = tree_->withholds(role_, !(F_H == Wrench()));
    Wrench sent = withheld ? Wrench() : F_H;
    behind_ = behind_ || withheld;
    if (behind_) {
      sent = {within(slew_.force * tick.period, sent.f, sent_.f), within(slew_.torque * tick.period, sent.t, sent_.t)};
      behind_ = withheld || !(sent == F_H);
    }
    sent_ = sent;
    inner().write(sent, tick);
  }
  void rearm() noexcept override {
    tree_->rearm(role_);
    inner().rearm();
  }
  bool points() const override { return true; }
  void point(const PointerState& pointer, const Tick& tick) noexcept override {
    tree_->wish(pointer.frames);
    if (inner().points()) inner().point(pointer, tick);
  }

 private:
  static Vec3 within(double step, const Vec3& wanted, const Vec3& last) noexcept {
    const Vec3 change = wanted - last;
    const double length = change.norm();
    return length <= step ? wanted : Vec3(last + change * (step / length));
  }
  std::shared_ptr<FrameTree> tree_;
  std::size_t role_;
  Slew slew_;
  Wrench sent_;          // the last one
  bool behind_ = false;  // of the command, since one was withheld
};

}  // namespace presa
