#pragma once
#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/core/exchange/bounded_list.h"
#include "framework/core/graph/port.h"
#include "framework/core/state/contact_exchange.h"
#include "framework/core/state/device_state.h"
#include "framework/haptics/tool_renderer.h"
#include "framework/scene/world.h"
#include "modules/haptics_proxy/tool_grip.h"

namespace presa {

/// The tools with volume of a scene: asks their renderer and writes its forces as contacts of their fingers. Thread:
/// haptic; step is nonblocking.
class HeldTools {
 public:
  /// `materials` must outlive it. Adds the port of the tools' states to `owner`.
  HeldTools(Module& owner, const World& world, const std::vector<Material>& materials);
  void step(const DeviceState& devices, double period, const Touchables& touchables, ContactExchange& out) noexcept;
  std::size_t maxForces() const noexcept { return forces_.capacity(); }             ///< of one tool
  bool broken() const noexcept { return broken_.load(std::memory_order_acquire); }  ///< thread: any
  std::string what() const { return renderer_->what(); }

 private:
  void touch(std::size_t tool, const FingerInput& input, double period, const Touchables& touchables,
             ContactExchange& out) noexcept;
  void write(const FingerInput& input, double share, const Touchables& touchables, ContactExchange& all,
             FingerContact& out) noexcept;

  std::vector<std::size_t> roles_;                // of the tools
  std::vector<std::optional<ToolGrip>> grips_{};  // by role; none: always held
  const std::vector<Material>& materials_;
  std::unique_ptr<ToolRenderer> renderer_;
  BoundedList<ToolForce> forces_;  // of one tool in its tick
  std::atomic<bool> broken_{false};
  Out<ToolStates> states_;
};

}  // namespace presa
