#pragma once
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "framework/core/graph/port.h"
#include "framework/core/schedule/schedule_log.h"

namespace presa {

/// One link from an output port to an input port. Within a rate group the reader sees the writer's value in
/// place; across groups the value goes through a bridge.
struct Connection {
  const OutPortBase* from = nullptr;  ///< writer's port
  const InPortBase* to = nullptr;     ///< reader's port
  BridgeBase* bridge = nullptr;       ///< null within a rate group
};

/// The frozen graph: modules in step order and their connections. Made by GraphBuilder only. Functions that
/// take a group are called on the one thread that runs this group; step and replayStep do not block.
class Graph {
 public:
  const std::vector<Connection>& connections() const noexcept { return connections_; }  ///< by the reader's port name
  /// Modules of one group in step order.
  const std::vector<Module*>& modules(RateGroup group) const noexcept { return groupOf(group).modules; }
  bool runs(RateGroup group) const noexcept { return !groupOf(group).modules.empty(); }  ///< the group has modules
  Module* find(const std::string& name) const noexcept;                                  ///< null: none has that name

  void start(RateGroup group);  ///< Module::start() of the group's modules in step order; throws what they throw
  /// Pulls the group's inputs, steps its modules in order and publishes their outputs.
  /// `row`, when given, receives the versions that were read.
  void step(RateGroup group, const Tick& tick, ScheduleRow* row = nullptr) noexcept;
  void stop(RateGroup group);  ///< Module::stop() in reverse order: readers before their writers
  /// The parts of step(), for measuring: pull the group's inputs, then step modules(group)[i] and publish its outputs.
  void pull(RateGroup group, const Tick& tick) noexcept;
  /// Call pull() before the first one.
  void stepModule(RateGroup group, std::size_t i, const Tick& tick) noexcept { stepModule(groupOf(group), i, tick); }

  /// Names of the values that each group reads across rates, in the order of ScheduleRow::versions.
  ScheduleInputs scheduleInputs() const;

  /// Replay: every bridge keeps published values in about `bytes` of memory; replayStep then reads recorded versions.
  void keepHistory(std::size_t bytes);
  /// Steps with the versions in `row`. False, without stepping, when one of them has not been published yet.
  bool replayStep(RateGroup group, const Tick& tick, const ScheduleRow& row) noexcept;

 private:
  friend class GraphBuilder;
  struct Group {
    std::vector<Module*> modules;
    std::vector<std::vector<BridgeBase*>> outputs;  ///< by module
    std::vector<BridgeBase*> inputs;                ///< in the order of ScheduleRow::versions: by name
    std::vector<std::string> input_names;
  };
  Group& groupOf(RateGroup group) noexcept { return groups_[static_cast<std::size_t>(group)]; }
  const Group& groupOf(RateGroup group) const noexcept { return groups_[static_cast<std::size_t>(group)]; }
  static void stepModule(Group& group, std::size_t i, const Tick& tick) noexcept;

  std::vector<std::unique_ptr<Module>> modules_;
  std::vector<std::unique_ptr<BridgeBase>> bridges_;
  std::vector<Connection> connections_;
  std::array<Group, kRateGroupCount> groups_;
};

}  // namespace presa
