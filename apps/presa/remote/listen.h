#pragma once
#include <cstdint>
#include <nlohmann/json.hpp>

#include "framework/scene/scene.h"

namespace presa {

/// What one viewer without a picture saw of a run.
struct Heard {
  std::uint64_t received = 0, lost = 0, doubled = 0, late = 0;
  std::uint64_t refused = 0;  ///< on the sender's side
  std::uint64_t overrun = 0;  ///< thrown away on this side
  double seconds = 0;
  double latency_p50 = 0, latency_p99 = 0, latency_max = 0;  ///< from sender to here, on one machine [s]
  bool joined = false, ended = false;
};

/// Joins, and listens for that long, or to the end of the run; `wait`: for a run [s]. Says on stderr when it has joined, unless quiet. `meshes`: folders as of bus::takeFromShelf.
Heard listen(const BusSettings& settings, const std::vector<std::string>& meshes, double wait, double duration,
             bool quiet);

nlohmann::ordered_json toJson(const Heard& heard);
Heard heardFrom(const nlohmann::json& json);

}  // namespace presa
