#include "tests/framework/record/recording_fixture.h"

#include <stdlib.h>

#include <cmath>

namespace presa::record {
namespace {

bool sameBits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }
bool sameBits(const Vec3& a, const Vec3& b) {
  return sameBits(a.x(), b.x()) && sameBits(a.y(), b.y()) && sameBits(a.z(), b.z());
}

bool same(const DeviceState& a, const DeviceState& b) {
  bool equal = sameBits(a.time, b.time) && a.count() == b.count() && a.stop_requested == b.stop_requested &&
               a.rearms == b.rearms;
  for (std::size_t f = 0; f < 2; ++f) {
    const FingerInput &x = a.fingers[f], &y = b.fingers[f];
    equal = equal && sameBits(x.p_WH, y.p_WH) && sameBits(x.v_WH, y.v_WH) && x.phase == y.phase && x.valid == y.valid;
  }
  return equal;
}

bool same(const ForceCommand& a, const ForceCommand& b) {
  return sameBits(a.time, b.time) && a.count() == b.count() && a.status == b.status &&
         sameBits(a.f_H_W[0], b.f_H_W[0]) && sameBits(a.f_H_W[1], b.f_H_W[1]);
}

void set(DeviceState& state, std::uint64_t tick) {
  state.time = fractionAt(tick, 0);
  state.stop_requested = bitsAt(tick, 2) % 2 == 1;
  state.rearms = static_cast<std::uint32_t>(bitsAt(tick, 6));
  for (std::size_t f = 0; f < 2; ++f) {
    state.fingers[f] = {vectorAt(tick, 10 + 20 * f), vectorAt(tick, 13 + 20 * f),
                        static_cast<std::int32_t>(bitsAt(tick, 16 + 20 * f) % 65537) - 1,
                        bitsAt(tick, 17 + 20 * f) % 2 == 1};
  }
}

void set(ForceCommand& command, std::uint64_t tick) {
  command.time = fractionAt(tick, 3);
  command.status = static_cast<std::uint32_t>(bitsAt(tick, 5));
  command.f_H_W[0] = vectorAt(tick, 20);
  command.f_H_W[1] = vectorAt(tick, 40);
}

}  // namespace

DeviceState deviceAt(std::uint64_t tick) {
  DeviceState state(2);
  set(state, tick);
  return state;
}

ForceCommand commandAt(std::uint64_t tick) {
  ForceCommand command(2);
  set(command, tick);
  return command;
}

void setObjects(ObjectState& state, std::uint64_t tick, double time) {
  state.time_begin = time - 0.001;
  state.time_end = time + 0.003;
  BodyMotion& cube = state.bodies[1];
  const auto height = static_cast<double>(tick);
  cube.X_WB_begin = {Vec3(0, 0, height), Quat::Identity()};
  cube.X_WB_end = {Vec3(0, 0, height + 4), Quat(0, 0, 0, 1)};
  cube.v_WB = Vec3(1, 2, 3);
  cube.w_WB = Vec3(4, 5, 6);
}

void Source::step(const Tick& tick) noexcept {
  set(device.value, tick.index);
  set(command.value, tick.index);
  setObjects(objects.value, tick.index, tick.time);
  contact.value.fingers[0].mode = ContactMode::kSlip;
  contact.value.fingers[0].body = 1;
  contact.value.fingers[0].depth = 0.25;
}

RecordedSetup recordedSetup(const std::string& file, bool realtime) {
  auto world = std::make_shared<World>();
  Scene& scene = world->scene;
  scene.name = "cube";
  scene.file = "scenes/cube.xml";
  scene.resolved_xml = "<scene>" + std::string(200'000, 'x') + "</scene>";
  scene.bodies.resize(2);
  scene.bodies[0].name = "table";
  scene.bodies[0].fixed = true;
  scene.bodies[1].name = "cube";
  scene.devices.resize(2);
  scene.devices[0].role = "thumb";  // not in alphabetical order
  scene.devices[1].role = "index";
  world->rig.resolved_xml = "<rig/>";
  RunOptions options;
  options.realtime = realtime;
  options.seed = 0xFEDCBA9876543210ull;
  options.record = file;
  return {std::move(world), std::move(options)};
}

ScheduleInputs inputsOfAll() {
  ScheduleInputs inputs;
  for (std::size_t g = 0; g < inputs.size(); ++g) {
    for (int v = ScheduleRow::kMaxBridges; v-- > 0;)  // not in alphabetical order
      inputs[g].push_back(std::string(toString(static_cast<RateGroup>(g))) + '_' + std::to_string(v));
  }
  return inputs;
}

RecordedRun::RecordedRun(const RecordedSetup& setup, WriterSettings settings, RecordedDevices devices)
    : rates(setup.world->scene.rates), recorder(nullptr), graph([&] {
        GraphBuilder builder;
        builder.add(std::make_unique<Source>());
        recorder = &builder.add(
            std::make_unique<FileRecorder>(setup.world, setup.options, std::move(devices), std::move(settings)));
        schedule.inputs = inputsOfAll();
        recorder->attach(schedule);
        builder.connectByName();
        return builder.build();
      }()) {}

RecordedRun::~RecordedRun() = default;

void RecordedRun::step(std::uint64_t ticks) {
  for (std::uint64_t i = 0; i < ticks; ++i, ++next) {
    ScheduleRow row;
    graph.step(RateGroup::kHaptic, rates.tick(RateGroup::kHaptic, next), &row);
    for (std::size_t v = 0; v < row.versions.size(); ++v) row.versions[v] = bitsAt(next, 100 + v);
    schedule.rings[0]->push(row);
    if (next % 5 == 0) {
      row.index = next / 5;
      schedule.rings[static_cast<std::size_t>(RateGroup::kDynamics)]->push(row);
    }
  }
}

std::string differenceFromPrefix(const Recording& recording) {
  const std::size_t ticks = recording.time.size();
  if (recording.device.size() != ticks || recording.command.size() != ticks) return "lists of different length";
  if (recording.inputs && *recording.inputs != inputsOfAll()) return "names of inputs";
  for (std::size_t i = 0; i < ticks; ++i) {
    if (!sameBits(recording.time[i], RateTable(Rates{}).tick(RateGroup::kHaptic, i).time))
      return "time of tick " + std::to_string(i);
    if (!same(recording.device[i], deviceAt(i))) return "device state of tick " + std::to_string(i);
    if (!same(recording.command[i], commandAt(i))) return "force command of tick " + std::to_string(i);
  }
  for (const auto group : {RateGroup::kHaptic, RateGroup::kDynamics}) {
    const auto& rows = recording.schedule[static_cast<std::size_t>(group)];
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const std::uint64_t tick = group == RateGroup::kHaptic ? i : i * 5;
      if (rows[i].index != i) return "index of schedule row " + std::to_string(i);
      for (std::size_t v = 0; v < rows[i].versions.size(); ++v) {
        if (rows[i].versions[v] != bitsAt(tick, 100 + v)) return "version in schedule row " + std::to_string(i);
      }
    }
  }
  return {};
}

}  // namespace presa::record
