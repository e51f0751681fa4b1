#pragma once
#include <atomic>

#include "framework/assembly/assembly_state.h"
#include "framework/core/graph/port.h"

namespace presa {

/// Counts the filled places of the scene's assembly for the result of a run. Runs in the rate group of the assembly
/// module.
class AssemblyObserver final : public Module {
 public:
  explicit AssemblyObserver(std::atomic<std::int32_t>& filled)
      : Module("assembly_observer", RateGroup::kCollision), filled_(filled) {}
  void step(const Tick&) noexcept override { filled_.store(assembly_->filled, std::memory_order_relaxed); }
  std::vector<std::string> stages() const override { return {"count the places that are filled"}; }

 private:
  std::atomic<std::int32_t>& filled_;
  In<AssemblyState> assembly_{*this, "assembly_state"};
};

}  // namespace presa
