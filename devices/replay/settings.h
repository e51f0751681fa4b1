#pragma once
#include <memory>
#include <string>
#include <vector>

#include "devices/replay/recorded_path.h"
#include "framework/core/diagnostics/diagnostics.h"
#include "framework/scene/world.h"

namespace presa {

struct ReplaySettings {
  std::shared_ptr<const RecordedPath> path;  ///< null on errors
  double speed = 1;                          ///< relative to the recorded motion; 1: as recorded
  bool lost_at_end = false;
  std::vector<std::string> notes;
};

/// Reads the rig settings and the recording; findings go to `diagnostics` (E401, E440 to E445).
ReplaySettings readReplaySettings(const DeviceBinding& binding, const World& world, Diagnostics& diagnostics);

}  // namespace presa
