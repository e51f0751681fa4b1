#include "framework/session/replay.h"

#include <algorithm>
#include <bit>
#include <numeric>

#include "framework/core/graph/port.h"
#include "framework/core/schedule/rates.h"
#include "framework/record/mesh_sums.h"
#include "framework/scene/guide_orders.h"
#include "framework/scene/open_surfaces.h"
#include "framework/scene/surface_change.h"
#include "framework/scene/surface_settings.h"

namespace presa {
namespace {

bool sameBits(const Vec3& a, const Vec3& b) noexcept {
  for (int i = 0; i < 3; ++i) {
    if (std::bit_cast<std::uint64_t>(a[i]) != std::bit_cast<std::uint64_t>(b[i])) return false;
  }
  return true;
}

const ForceCommand* commandOf(const Graph& graph) {
  for (const Connection& connection : graph.connections()) {
    if (connection.from->name() != "force_command") continue;
    return &static_cast<const Out<ForceCommand>*>(connection.from)->value;
  }
  return nullptr;
}

/// A finger of a recording: returns the recorded samples, ignores forces.
class RecordedFinger final : public Device {
 public:
  RecordedFinger(const Recording& recording, std::size_t finger) : recording_(recording), finger_(finger) {}
  FingerInput read(const Tick&) noexcept override { return recording_.device[row_++].fingers[finger_]; }
  void write(const Wrench&, const Tick&) noexcept override {}
  bool measuresOrientation() const override { return recording_.device.front().fingers[finger_].oriented; }

 private:
  const Recording& recording_;
  std::size_t finger_;
  std::size_t row_ = 0;
};

class RecordedSurfaces final : public Module {
 public:
  explicit RecordedSurfaces(const Recording& recording)
      : Module("recorded_surfaces", RateGroup::kHaptic), recording_(recording) {}
  void step(const Tick&) noexcept override { change_.value.happened = recording_.surfaces_changed[row_++] != 0; }
  std::vector<std::string> stages() const override { return {"repeat the recorded surface changes"}; }

 private:
  const Recording& recording_;
  std::size_t row_ = 0;
  Out<SurfaceChange> change_{*this, "surface_change"};
};

class RecordedCommands final : public Module {
 public:
  explicit RecordedCommands(const Recording& recording)
      : Module("recorded_commands", RateGroup::kHaptic), recording_(recording) {}
  void step(const Tick&) noexcept override {
    const auto& commands = recording_.commands;
    if (next_ < commands.size() && commands[next_].row == row_) {
      const Recording::Command& command = commands[next_++];
      SurfaceSettings& settings = settings_.value;
      if (command.slot < settings.slots.size()) settings.slots[command.slot] = {++settings.newest, command.value};
    }
    ++row_;
  }
  std::vector<std::string> stages() const override { return {"repeat the recorded parameter changes"}; }

 private:
  const Recording& recording_;
  std::size_t row_ = 0, next_ = 0;
  Out<SurfaceSettings> settings_{*this, "surface_settings"};
};

/// Repeats what a guide in a viewer ordered, in the ticks in which the assembly module took it.
class RecordedOrders final : public Module {
 public:
  RecordedOrders(const Recording& recording, std::size_t goals)
      : Module("recorded_orders", RateGroup::kCollision), recording_(recording) {
    orders_.value.draws.resize(goals);
  }
  void step(const Tick& tick) noexcept override {
    for (; next_ < recording_.orders.size() && recording_.orders[next_].tick <= tick.index; ++next_) {
      const TakenOrders::Order& order = recording_.orders[next_];
      if (order.goal == TakenOrders::kUndo) ++orders_.value.undone;
      if (order.goal < 0 || static_cast<std::size_t>(order.goal) >= orders_.value.draws.size()) continue;
      GuideOrders::Draw& draw = orders_.value.draws[static_cast<std::size_t>(order.goal)];
      draw = {order.body, draw.since + 1};
    }
  }
  std::vector<std::string> stages() const override { return {"repeat the recorded orders of the guide"}; }

 private:
  const Recording& recording_;
  std::size_t next_ = 0;
  Out<GuideOrders> orders_{*this, kGuideOrdersPort};
};

constexpr std::array kGroups{RateGroup::kDynamics, RateGroup::kCollision, RateGroup::kHaptic};

class Replayer {
 public:
  Replayer(const Recording& recording, const ScheduleColumns& columns, Session& session, const RateTable& rates,
           RunControl& control)
      : recording_(recording),
        columns_(columns),
        session_(session),
        rates_(rates),
        control_(control),
        command_(commandOf(session.graph())) {
    result_.recorded = recording.time.size();
    result_.fingers = command_ == nullptr ? 0 : recording.fingers;
  }

  ReplayResult run() {
    Graph& graph = session_.graph();
    constexpr std::size_t kHistoryBytes = 32u << 20;
    graph.keepHistory(kHistoryBytes);
    for (RateGroup group : kGroups) graph.start(group);
    // each group advances as soon as the versions of its next tick are published: a possible order of the original run
    bool moved = true;
    while (moved) {
      moved = false;
      for (RateGroup group : kGroups) moved = advance(group) || moved;
    }
    for (RateGroup group : kGroups) graph.stop(group);
    if (next_[static_cast<std::size_t>(RateGroup::kHaptic)] < rows(RateGroup::kHaptic)) {
      result_.problem = "tick " + std::to_string(result_.ticks) + " read a value that the recording does not hold";
    }
    return result_;
  }

 private:
  std::size_t rows(RateGroup group) const {
    const std::size_t schedule = recording_.schedule[static_cast<std::size_t>(group)].size();
    return group == RateGroup::kHaptic ? std::min(schedule, recording_.device.size()) : schedule;
  }

  bool advance(RateGroup group) {
    if (!session_.graph().runs(group)) return false;
    const auto g = static_cast<std::size_t>(group);
    if (next_[g] >= rows(group)) return false;
    const ScheduleRow row = inOrder(recording_.schedule[g][next_[g]], columns_[g]);
    if (group == RateGroup::kHaptic) {
      control_.stop_requested = recording_.device[next_[g]].stop_requested;
      control_.rearms = recording_.device[next_[g]].rearms;
    }
    Tick tick = rates_.tick(group, row.index);
    tick.catch_up = (row.catch_up & 1U) != 0;
    tick.resumed = (row.catch_up & 2U) != 0;
    tick.late = (row.catch_up & 4U) != 0;
    if (!session_.graph().replayStep(group, tick, row)) return false;
    if (group == RateGroup::kHaptic) compare(next_[g]);
    ++next_[g];
    return true;
  }

  /// The recorded row with its versions in the order of the replay's inputs.
  static ScheduleRow inOrder(const ScheduleRow& recorded, const std::vector<std::size_t>& columns) {
    ScheduleRow row = recorded;
    for (std::size_t i = 0; i < columns.size(); ++i) row.versions[i] = recorded.versions[columns[i]];
    return row;
  }

  void compare(std::size_t row) {
    ++result_.ticks;
    if (command_ == nullptr) return;
    bool same = true;
    for (std::size_t f = 0; f < result_.fingers; ++f) {
      const Vec3 &now = command_->f_H_W[f], &then = recording_.command[row].f_H_W[f];
      if (sameBits(now, then) && sameBits(command_->t_H_W[f], recording_.command[row].t_H_W[f])) continue;
      same = false;
      result_.largest_difference = std::max(result_.largest_difference, (now - then).norm());
    }
    if (same) return;
    if (result_.differing++ == 0) result_.first_difference = recording_.time[row];
  }

  const Recording& recording_;
  const ScheduleColumns& columns_;
  Session& session_;
  const RateTable& rates_;
  RunControl& control_;
  const ForceCommand* command_;
  std::array<std::size_t, kScheduledGroupCount> next_{};
  ReplayResult result_;
};

DeviceList devicesOf(const Recording& recording) {
  DeviceList devices;
  for (std::size_t f = 0; f < recording.fingers; ++f) devices.push_back(std::make_unique<RecordedFinger>(recording, f));
  return devices;
}

/// Checks that the recording has the fingers of its scene. Without them, the session would open the devices of the rig.
void checkBelongs(const Recording& recording, const Scene& scene, Diagnostics& diagnostics) {
  const auto compare = [&](const std::string& what, auto recorded, auto in_scene) {
    if (recorded == in_scene) return;
    diagnostics.error(
        677, {recording.file, 0, 0},
        what + ": the recording has " + std::to_string(recorded) + ", its own scene_xml " + std::to_string(in_scene),
        "scene and recording are of one run; was it changed since it was recorded?");
  };
  compare("fingers", recording.fingers, scene.devices.size());
  compare("bodies", recording.bodies, scene.bodies.size());
  const auto goals = static_cast<std::int32_t>(scene.assembly ? scene.assembly->goals.size() : 0);
  for (const TakenOrders::Order& order : recording.orders) {
    if (order.goal < goals) continue;
    diagnostics.error(677, {recording.file, 0, 0},
                      "haptic/guide: column 'goal': found " + std::to_string(order.goal) + ", its scene has " +
                          std::to_string(goals) + " goals");
    break;
  }
  if (recording.guided && goals == 0)
    diagnostics.error(677, {recording.file, 0, 0},
                      "haptic/guide: the recording has a guide, its scene has no assembly");
  compare("haptic period [s]", recording.haptic_period, RateTable(scene.rates).period(RateGroup::kHaptic));
  const std::size_t open = openSurfaces(scene).size();
  for (const Recording::Command& command : recording.commands) {
    if (command.slot < open) continue;
    return diagnostics.error(677, {recording.file, 0, 0},
                             "haptic/ticks: column 'commanded', row " + std::to_string(command.row) + ": found " +
                                 std::to_string(command.slot + 1) + ", its scene has " + std::to_string(open) +
                                 " surfaces that a command can change");
  }
}

/// Another mesh gives other forces: then a replay would say that the program differs.
void checkMeshes(const Recording& recording, const Scene& scene, Diagnostics& diagnostics) {
  for (const std::string& sentence : changedMeshes(recording.file, scene))
    diagnostics.error(679, {recording.file, 0, 0}, sentence, "put the mesh of the run back, and replay it again");
}

/// Modules that repeat the recorded changes; none if nothing changed during the run.
std::vector<std::unique_ptr<Module>> changesOf(const Recording& recording, const Scene& scene) {
  std::vector<std::unique_ptr<Module>> changes;
  const auto& changed = recording.surfaces_changed;
  if (std::find(changed.begin(), changed.end(), 1) != changed.end())
    changes.push_back(std::make_unique<RecordedSurfaces>(recording));
  if (!recording.commands.empty()) changes.push_back(std::make_unique<RecordedCommands>(recording));
  if (recording.guided) changes.push_back(std::make_unique<RecordedOrders>(recording, scene.assembly->goals.size()));
  return changes;
}

bool readsUnconnected(const Graph& graph, RateGroup group, const std::string& name) {
  for (const Module* module : graph.modules(group)) {
    for (const InPortBase* input : module->inputs()) {
      if (input->name() == name && !input->connected()) return true;
    }
  }
  return false;
}

/// For each group and each value that the replay reads across rates: its column of versions in the recording. Recorded
/// names that the replay reads within the group (commands) or not at all (the pointer in the window) are ignored.
ScheduleColumns columnsOf(const Recording& recording, const Graph& graph, Diagnostics& diagnostics) {
  ScheduleColumns columns;
  const ScheduleInputs replayed = graph.scheduleInputs();
  for (const RateGroup group : kGroups) {
    const auto g = static_cast<std::size_t>(group);
    columns[g].resize(replayed[g].size());
    std::iota(columns[g].begin(), columns[g].end(), 0);
    if (!recording.inputs || recording.schedule[g].empty()) continue;
    const std::vector<std::string>& recorded = (*recording.inputs)[g];
    const auto wrong = [&](const std::string& what) {
      diagnostics.error(678, {recording.file, 0, 0}, std::string("schedule/") + toString(group) + ": " + what,
                        "replay it with the version of Presa that recorded it: " + recording.program_version);
    };
    for (std::size_t i = 0; i < replayed[g].size(); ++i) {
      const auto found = std::find(recorded.begin(), recorded.end(), replayed[g][i]);
      columns[g][i] = static_cast<std::size_t>(found - recorded.begin());
      if (found == recorded.end())
        wrong("a replay reads '" + replayed[g][i] + "' across rates; attribute 'inputs' does not name it");
    }
    for (const std::string& name : recorded) {
      if (std::find(replayed[g].begin(), replayed[g].end(), name) == replayed[g].end() &&
          readsUnconnected(graph, group, name))
        wrong("attribute 'inputs' names '" + name + "'; in a replay nothing writes it");
    }
  }
  return columns;
}

}  // namespace

RecordedRun::RecordedRun(const Recording& recording, Diagnostics& diagnostics) : recording_(recording) {
  RunOptions options;
  options.seed = recording.seed;
  options.force_share = recording.force_share;
  options.bus = BusSettings{.network = "none"};  // a replay is not published
  options.bus_commands = !recording.commands.empty();
  if (recording.guided) options.guide = RunOptions::Guide::kViewer;
  Loaded loaded =
      loadWithoutDevices({recording.scene_xml, recording.scene_file, recording.rig_xml}, options, diagnostics);
  if (!diagnostics.hasErrors()) checkBelongs(recording, loaded.world->scene, diagnostics);
  if (!diagnostics.hasErrors()) checkMeshes(recording, loaded.world->scene, diagnostics);
  if (diagnostics.hasErrors()) return;
  Session::Options session_options;
  session_options.devices = devicesOf(recording);
  session_options.more = changesOf(recording, loaded.world->scene);
  session_ = std::make_unique<Session>(std::move(loaded), control_, std::move(session_options));
  columns_ = columnsOf(recording, session_->graph(), diagnostics);
  if (diagnostics.hasErrors()) session_.reset();
}

ReplayResult RecordedRun::run() {
  const RateTable rates(world()->scene.rates);
  return Replayer(recording_, columns_, *session_, rates, control_).run();
}

}  // namespace presa
