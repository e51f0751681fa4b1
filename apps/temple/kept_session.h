#pragma once
#include <optional>
#include <string>
#include <vector>

#include "apps/temple/building/block.h"
#include "framework/core/diagnostics/diagnostics.h"

namespace presa::temple {

/// The saved state of a visit, from which another process can continue it.
struct KeptSession {
  std::string size, parameters;  ///< the building: name of a shipped one, or a file
  std::uint64_t seed = 1;
  double elapsed = 0;      ///< elapsed assembly time [s]
  int placed = 0;          ///< number of blocks at their goals
  std::vector<Pose> X_WB;  ///< pose of each block
  bool tenon = false;      ///< capitals have tenons
};

/// Default folder of saved visits: $XDG_STATE_HOME/presa/temple, or ~/.local/state/presa/temple.
std::string defaultVisitFolder();
std::string sessionFile(const std::string& folder);
std::string logFile(const std::string& folder);

/// The session as JSON. Numbers are read back bit-exactly.
std::string keptText(const KeptSession& kept);
/// Reads a session's text. Throws std::exception when it is none.
KeptSession keptOf(const std::string& text);
/// Reads a session. E967: the file cannot be read or is not a session.
std::optional<KeptSession> readKept(const std::string& file, Diagnostics& diagnostics);

}  // namespace presa::temple
