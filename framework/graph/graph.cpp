#include "framework/graph/graph.h"

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
    const std::uint64_t version = g.inputs[i]->pull();
    if (row != nullptr) row->versions[i] = version;
  }
  if (row != nullptr) row->index = tick.index;
  stepModules(g, tick);
}

void Graph::stepModules(Group& group, const Tick& tick) noexcept {
  for (std::size_t i = 0; i < group.modules.size(); ++i) {
    group.modules[i]->step(tick);
    for (BridgeBase* bridge : group.outputs[i].bridges) bridge->push(tick.time);
  }
}

void Graph::stop(RateGroup group) {
  // in reverse, so that a reader never outlives what it reads
  auto& modules = groupOf(group).modules;
  for (auto it = modules.rbegin(); it != modules.rend(); ++it) (*it)->stop();
}

void Graph::keepHistory(std::size_t bytes) {
  for (const auto& bridge : bridges_) bridge->keepHistory(bytes);
}

bool Graph::replayStep(RateGroup group, const Tick& tick, const ScheduleRow& row) noexcept {
  Group& g = groupOf(group);
  for (std::size_t i = 0; i < g.inputs.size(); ++i) {
    if (!g.inputs[i]->pullVersion(row.versions[i])) return false;
  }
  stepModules(g, tick);
  return true;
}

}  // namespace presa
