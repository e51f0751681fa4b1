#pragma once
#include <algorithm>
#include <string>
#include <vector>

#include "framework/record/haptic_observer.h"
#include "framework/scene/scene.h"
#include "framework/scene/tool_state.h"

namespace presa {

/// How one tool fared over a run.
struct ToolSummary {
  std::string name;           ///< device role
  std::uint32_t touched = 0,  ///< ticks in contact
      coarse = 0,             ///< ticks that examined its surface more coarsely than it is given
      late = 0,               ///< ticks at whose end tool and forces were not in balance yet
      most_points = 0;        ///< places in contact in one tick
  double deepest = 0;         ///< [m]
};

/// Keeps the summaries of all tools. Read them after the run.
class ToolLog final : public HapticObserver {
 public:
  /// Writes to `tools`, which must outlive this: one for each tool, in the order of the roles.
  ToolLog(const Scene& scene, std::vector<ToolSummary>& tools) : HapticObserver("tool_log"), tools_(tools) {
    tools_.clear();
    for (std::size_t d = 0; d < scene.devices.size(); ++d) {
      if (!scene.devices[d].tool) continue;
      roles_.push_back(d);
      tools_.push_back({.name = scene.devices[d].role});
    }
  }

  void observe(const HapticSample& /*sample*/) noexcept override {
    if (!states_.hasValue()) return;
    for (std::size_t i = 0; i < roles_.size(); ++i) {
      const ToolState& state = states_->tools[roles_[i]];
      ToolSummary& sum = tools_[i];
      sum.touched += state.points > 0;
      sum.coarse = state.coarse;
      sum.late = state.late;
      sum.most_points = std::max(sum.most_points, state.points);
      sum.deepest = std::max(sum.deepest, state.depth);
    }
  }
  std::vector<std::string> stages() const override { return {"depth and balance of the tools"}; }

 private:
  std::vector<std::size_t> roles_;
  std::vector<ToolSummary>& tools_;
  In<ToolStates> states_{*this, kToolStatesPort, In<ToolStates>::Optional{}};
};

}  // namespace presa
