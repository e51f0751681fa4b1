#include "framework/record/recording.h"

#include <stdexcept>

#include "framework/plugin/plugin_loader.h"
#include "framework/record/record_plugin.h"

namespace presa {
namespace {

// Eight seconds at the highest haptic rate (4 kHz); no group is faster than the haptic one. In lockstep the recorder
// relies on this being twice the capacity of its own ring, see FileRecorder::handOver.
constexpr std::size_t kScheduleCapacity = 32768;

}  // namespace

ScheduleLog::ScheduleLog() {
  for (auto& ring : rings) {
    ring = std::make_unique<EventRing<ScheduleRow>>(kScheduleCapacity);
    // touch every page now, so that no tick causes a page fault
    ScheduleRow row;
    for (std::size_t i = 0; i < kScheduleCapacity; ++i) ring->push(row);
    while (ring->pop(row)) {
    }
  }
}

const std::vector<double>& RecordedTable::values(const std::string& column) const {
  for (const Column& one : columns) {
    if (one.name == column) return one.values;
  }
  throw std::out_of_range(name + " has no column " + column);
}

const RecordPlugin& recordPlugin() {
  using Entry = const RecordPlugin* (*)();
  static const RecordPlugin* const plugin = reinterpret_cast<Entry>(pluginSymbol("record", "presaRecordPlugin"))();
  if (plugin->abi != kPluginAbi) {
    Diagnostics diagnostics;
    diagnostics.error(600, {}, "the plug-in presa_record.so belongs to another version of Presa",
                      "rebuild it with this version");
    throw InputError(std::move(diagnostics));
  }
  return *plugin;
}

}  // namespace presa
