#pragma once
#include <vector>

#include "apps/presa/remote/listen.h"

namespace presa {

/// What the bus is to be measured with.
struct MeasureSettings {
  BusSettings bus;
  int objects = 120, viewers = 2;
  double duration = 60;  ///< [s]
  bool quiet = false;
};

/// One answer for each viewer; each is a process of its own, and so is the sender (this one). On Ctrl-C what there is.
std::vector<Heard> measureBus(const MeasureSettings& settings);

}  // namespace presa
