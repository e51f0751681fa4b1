#include "framework/core/graph/graph.h"

namespace presa {

Module* Graph::find(const std::string& name) const noexcept {
  for (const auto& module : modules_) {
    if (module->name() == name) return module.get();
  }
  return nullptr;
}

void Graph::start(RateGroup group) {
  for (Module* module : groupOf(group).modules) module->start();
}

void Graph::step(RateGroup group, const Tick& tick, ScheduleRow* row) noexcept {
  Group& g = groupOf(group);
  for (std::size_t i = 0; i < g.inputs.size(); ++i) {
    const std::uint64_t version = g.inputs[i]->pull(group, tick);
    if (row != nullptr) row->versions[i] = version;
  }
  if (row != nullptr) {
    row->index = tick.index;
    row->catch_up = (tick.catch_up ? 1U : 0U) | (tick.resumed ? 2U : 0U) | (tick.late ? 4U : 0U);
  }
  for (std::size_t i = 0; i < g.modules.size(); ++i) stepModule(g, i, tick);
}

void Graph::stepModule(Group& group, std::size_t i, const Tick& tick) noexcept {
  group.modules[i]->step(tick);
  for (BridgeBase* bridge : group.outputs[i]) bridge->push(tick);
}

void Graph::pull(RateGroup group, const Tick& tick) noexcept {
  for (BridgeBase* bridge : groupOf(group).inputs) bridge->pull(group, tick);
}

void Graph::stop(RateGroup group) {
  // in reverse order, so that readers stop before their writers
  auto& modules = groupOf(group).modules;
  for (auto it = modules.rbegin(); it != modules.rend(); ++it) (*it)->stop();
}

ScheduleInputs Graph::scheduleInputs() const {
  ScheduleInputs names;
  for (std::size_t g = 0; g < names.size(); ++g) names[g] = groups_[g].input_names;
  return names;
}

void Graph::keepHistory(std::size_t bytes) {
  for (const auto& bridge : bridges_) bridge->keepHistory(bytes);
}

bool Graph::replayStep(RateGroup group, const Tick& tick, const ScheduleRow& row) noexcept {
  Group& g = groupOf(group);
  for (std::size_t i = 0; i < g.inputs.size(); ++i) {
    if (!g.inputs[i]->pullVersion(group, row.versions[i])) return false;
  }
  for (std::size_t i = 0; i < g.modules.size(); ++i) stepModule(g, i, tick);
  return true;
}

}  // namespace presa
