#pragma once
#include <vector>

#include "apps/presa/remote/listen.h"

namespace presa {

/// Settings of a measurement of the bus.
struct MeasureSettings {
  BusSettings bus;
  int objects = 120, viewers = 2;
  double duration = 60;  ///< [s]
  bool quiet = false;
};

/// Returns one result per viewer. Each viewer is a process of its own; this process sends. On Ctrl-C, returns the
/// results so far.
std::vector<ViewerStatistics> measureBus(const MeasureSettings& settings);

}  // namespace presa
