#pragma once
#include <cstdint>
#include <nlohmann/json.hpp>

#include "framework/scene/scene.h"

namespace presa {

/// Statistics of one viewer without a picture.
struct ViewerStatistics {
  std::uint64_t received = 0, lost = 0, doubled = 0, late = 0;
  std::uint64_t refused = 0;  ///< samples refused on the sender's side
  std::uint64_t overrun = 0;  ///< samples dropped on this side
  double seconds = 0;
  double latency_p50 = 0, latency_p99 = 0, latency_max = 0;  ///< from sender to here, on one machine [s]
  bool joined = false, ended = false;
};

/// Joins a run and listens for the duration, or to the end of the run; waits up to `wait` for a run [s]. Unless quiet,
/// reports on stderr when it has joined. `meshes`: folders as in bus::takeFromMeshStore.
ViewerStatistics listen(const BusSettings& settings, const std::vector<std::string>& meshes, double wait,
                        double duration, bool quiet);

nlohmann::ordered_json toJson(const ViewerStatistics& statistics);
ViewerStatistics statisticsFrom(const nlohmann::json& json);

}  // namespace presa
