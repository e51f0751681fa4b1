#pragma once
#include <fstream>
#include <string>
#include <vector>

#include "apps/temple/kept_session.h"
#include "apps/temple/visit_tap.h"

namespace presa::temple {

/// Keeps a visit in a folder while it goes on: a line of log.jsonl for everything that happens, and session.json, replaced as a whole
/// after everything that is placed or taken out. Neither says anything about a person. Thread: main.
class VisitLog {
 public:
  /// Makes the folder. `base`: what the visit starts with. Throws std::system_error.
  VisitLog(const std::string& folder, KeptSession base, const Scene& scene, const std::string& language);

  void note(const std::vector<GuideEvent>& events, const VisitTap::Look& look);
  /// Other than what the guide sees: "attract", "takeover", "end".
  void note(const std::string& event, double time);

 private:
  void write(const std::string& line);
  void keep(const VisitTap::Look& look);

  const Scene& scene_;
  std::string file_;
  KeptSession kept_;
  std::ofstream log_;
};

}  // namespace presa::temple
