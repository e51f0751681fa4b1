#pragma once
#include <atomic>
#include <memory>

#include "framework/assembly/assembly_control.h"
#include "framework/core/graph/port.h"
#include "framework/session/module_plugin.h"
#include "modules/assembly/goal_regions.h"

namespace presa::assembly {

/// Module of the assembly task: object state in, snap constraints and assembly state out. Thread: collision.
class AssemblyModule final : public Module, public AssemblyControl {
 public:
  explicit AssemblyModule(std::shared_ptr<const World> world);

  void step(const Tick& tick) noexcept override;
  std::vector<std::string> stages() const override;
  void undo() noexcept override { undos_.fetch_add(1, std::memory_order_relaxed); }

 private:
  In<ObjectState> objects_;
  Out<SnapConstraints> snap_constraints_;
  Out<AssemblyState> state_;
  std::shared_ptr<const World> world_;
  GoalRegions regions_;
  std::atomic<std::uint32_t> undos_{0};
  std::uint32_t undone_ = 0;
};

}  // namespace presa::assembly
