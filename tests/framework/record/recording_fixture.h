#pragma once
#include <bit>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "apps/common/scratch_folder.h"
#include "framework/core/graph/graph_builder.h"
#include "framework/core/schedule/rates.h"
#include "framework/record/record_plugin/recorder.h"

namespace presa::record {

/// A 64-bit pattern that depends on tick and place: any bits, NaN and infinity included.
inline std::uint64_t bitsAt(std::uint64_t tick, std::uint64_t place) {
  std::uint64_t z = (tick * 1000003 + place + 1) * 0x9E3779B97F4A7C15ull;  // splitmix64
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
  return z ^ (z >> 31);
}
inline double realAt(std::uint64_t tick, std::uint64_t place) { return std::bit_cast<double>(bitsAt(tick, place)); }
/// A time from 1 to 2 with arbitrary mantissa bits.
inline double fractionAt(std::uint64_t tick, std::uint64_t place) {
  return std::bit_cast<double>((bitsAt(tick, place) >> 12) | 0x3FF0000000000000ull);
}
inline Vec3 vectorAt(std::uint64_t tick, std::uint64_t place) {
  return {realAt(tick, place), realAt(tick, place + 1), realAt(tick, place + 2)};
}

DeviceState deviceAt(std::uint64_t tick);
ForceCommand commandAt(std::uint64_t tick);
/// Smooth motion: the cube falls and turns, so that poses can be checked by formula.
void setObjects(ObjectState& state, std::uint64_t tick, double time);

/// Stands in for all modules of the haptic and dynamics groups.
class Source final : public Module {
 public:
  Source() : Module("source", RateGroup::kHaptic) {
    device.value = DeviceState(2);
    contact.value = ContactExchange(2);
    command.value = ForceCommand(2);
    objects.value.bodies.resize(2);
  }
  void step(const Tick& tick) noexcept override;
  Out<DeviceState> device{*this, "device_state"};
  Out<ContactExchange> contact{*this, "contact_exchange"};
  Out<ForceCommand> command{*this, "force_command"};
  Out<ObjectState> objects{*this, "object_state"};
};

/// Two fingers, a fixed table and a free cube.
struct RecordedSetup {
  std::shared_ptr<World> world;
  RunOptions options;
};
RecordedSetup recordedSetup(const std::string& file, bool realtime);

/// Names of the inputs of a RecordedRun's schedule: one for every version column.
ScheduleInputs inputsOfAll();

/// A recorder connected to a Source in one graph.
struct RecordedRun {
  explicit RecordedRun(const RecordedSetup& setup, WriterSettings settings = {}, RecordedDevices devices = {});
  ~RecordedRun();
  void step(std::uint64_t ticks);

  RateTable rates;
  ScheduleLog schedule;
  FileRecorder* recorder;
  Graph graph;
  std::uint64_t next = 0;
};

/// "" when the recording equals the first recording.time.size() ticks of a RecordedRun bit by bit, else the difference.
std::string differenceFromPrefix(const Recording& recording);

}  // namespace presa::record
