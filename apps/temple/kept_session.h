#pragma once
#include <optional>
#include <string>
#include <vector>

#include "apps/temple/building/block.h"
#include "framework/core/diagnostics/diagnostics.h"

namespace presa::temple {

/// What a visit leaves on the disk, so that another process can go on with it.
struct KeptSession {
  std::string size, parameters;  ///< of the building: shipped, or a file
  std::uint64_t seed = 1;
  double spent = 0;        ///< that people have worked on it [s]
  int placed = 0;          ///< blocks that stood
  std::vector<Pose> X_WB;  ///< by block
};

/// Where visits are kept unless the user says otherwise: $XDG_STATE_HOME/presa/temple, or ~/.local/state/presa/temple.
std::string defaultVisitFolder();
std::string sessionFile(const std::string& folder);
std::string logFile(const std::string& folder);

/// JSON. Numbers come back to the bit.
std::string keptText(const KeptSession& kept);
/// E967: the file cannot be read, or says something else. Nothing is written.
std::optional<KeptSession> readKept(const std::string& file, Diagnostics& diagnostics);

}  // namespace presa::temple
