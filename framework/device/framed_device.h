#pragma once
#include <memory>
#include <utility>

#include "framework/device/frame_tree.h"
#include "framework/device/wrapped_device.h"

namespace presa {

/// A device that stands in a frame of the rig, or whose tool carries one: samples go from the frame to the world,
/// forces back, with the same power (FrameMotion). Around no other device: without frames nothing is in the tick.
class FramedDevice final : public WrappedDevice {
 public:
  /// `frame`: index in the tree.
  FramedDevice(std::unique_ptr<Device> device, std::shared_ptr<FrameTree> tree, int frame, std::size_t role)
      : WrappedDevice(std::move(device)), tree_(std::move(tree)), frame_(frame), role_(role) {}

  FingerInput read(const Tick& tick) noexcept override {
    FingerInput sample = inner().read(tick);
    const FrameMotion frame = tree_->at(frame_, tick.time);
    q_WF_ = frame.X_WF.q;
    scale_ = frame.scale;
    sample.v_WH = frame.velocityAt(sample.p_WH, sample.v_WH);
    sample.p_WH = frame.pointAt(sample.p_WH);
    if (sample.oriented) {
      sample.q_WT = q_WF_ * sample.q_WT;
      sample.w_WT = frame.w_WF + q_WF_ * sample.w_WT;
    }
    sample.valid = sample.valid && tree_->known(frame_);
    if (tree_->carries(role_))
      tree_->track(role_, {{sample.p_WH, sample.q_WT}, sample.v_WH, sample.w_WT}, sample.valid, tick.time);
    return sample;
  }
  void write(const Wrench& F_H_W, const Tick& tick) noexcept override {
    const Quat q_FW = q_WF_.conjugate();
    inner().write({scale_ * (q_FW * F_H_W.f), q_FW * F_H_W.t}, tick);
  }

 private:
  std::shared_ptr<FrameTree> tree_;
  int frame_;
  std::size_t role_;
  Quat q_WF_ = Quat::Identity();  // of the last sample
  double scale_ = 1;
};

}  // namespace presa
