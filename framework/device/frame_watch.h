#pragma once
#include <atomic>
#include <memory>
#include <utility>

#include "framework/core/graph/port.h"
#include "framework/core/state/contact_exchange.h"
#include "framework/core/state/device_state.h"
#include "framework/device/frame_tree.h"
#include "framework/device/output_stage.h"

namespace presa {

/// Tells where the frames of the rig are, to the picture, the recording and the terminal; and tells frames that a user
/// moves of fingers whose device gets no force although they may touch a body: after a fault, or with old inputs. Only
/// in runs whose rig has frames.
class FrameWatch final : public Module {
 public:
  /// `tree`: shared with the devices in its frames.
  explicit FrameWatch(std::shared_ptr<FrameTree> tree)
      : Module("frame_watch", RateGroup::kHaptic),
        tree_(std::move(tree)),
        doing_(tree_->frames()),
        zoom_(doing_.size()) {
    state_.value = FrameState(tree_->frames());
  }
  void step(const Tick& tick) noexcept override {
    doubt();
    tree_->tell(tick.time, state_.value);
    for (std::size_t n = 0; n < doing_.size(); ++n) {
      doing_[n].store(state_.value.frames[n].doing, std::memory_order_relaxed);
      zoom_[n].store(state_.value.frames[n].zoom, std::memory_order_relaxed);
    }
  }
  std::vector<std::string> stages() const override { return {"tell where the frames of the rig are"}; }

  /// What is done with a frame of the rig now, for a sentence. Any thread.
  FrameNow now(std::size_t frame) const noexcept {
    FrameNow now;
    now.doing = doing_[frame].load(std::memory_order_relaxed);
    now.zoom = zoom_[frame].load(std::memory_order_relaxed);
    return now;
  }
  /// The last state. Main thread, after the run.
  const FrameState& last() const noexcept { return state_.value; }

 private:
  void doubt() noexcept {
    if (!contact_.connected() || !command_.connected()) return;
    const bool stopped = (command_.value().status & (kOutputLatches | kOutputWatchdog)) != 0;
    const auto& fingers = contact_.value().fingers;
    for (std::size_t f = 0; f < fingers.size() && f < tree_->roles(); ++f)
      tree_->doubt(f, stopped || !fingers[f].f_H_W.isZero() || !fingers[f].t_H_W.isZero());
  }

  std::shared_ptr<FrameTree> tree_;
  std::vector<std::atomic<std::uint32_t>> doing_;
  std::vector<std::atomic<double>> zoom_;
  In<DeviceState> device_{*this, "device_state"};  // after the devices
  In<ContactExchange> contact_{*this, "contact_exchange", In<ContactExchange>::Optional{}};
  In<ForceCommand> command_{*this, "force_command", In<ForceCommand>::Optional{}};
  Out<FrameState> state_{*this, kFramesPort};
};

}  // namespace presa
