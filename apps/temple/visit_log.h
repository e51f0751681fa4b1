#pragma once
#include <fstream>
#include <string>
#include <vector>

#include "apps/temple/help/help_level.h"
#include "apps/temple/kept_session.h"
#include "apps/temple/visit_observer.h"

namespace presa::temple {

/// Saves a visit in a folder while it runs: log.jsonl has a line per event, and session.json is replaced atomically
/// after every block that is placed or taken out. Neither holds personal data. Thread: main.
class VisitLog {
 public:
  /// Creates the folder. `base`: initial state of the visit; `guide`: where the guide runs, "beside" the dynamics or in
  /// a
  /// "viewer". Throws std::system_error.
  VisitLog(const std::string& folder, KeptSession base, const Scene& scene, const std::string& language,
           const std::string& guide);

  void note(const std::vector<GuideEvent>& events, const VisitObserver::Snapshot& snapshot);
  /// How strong the help with grasping is from now on, and how much of it the last block needed.
  void note(const std::vector<HelpNote>& notes);
  /// Events that do not come from the guide: "attract", "takeover", "end".
  void note(const std::string& event, double time);

 private:
  void write(const std::string& line);
  void keep(const VisitObserver::Snapshot& snapshot);

  const Scene& scene_;
  std::string file_;
  KeptSession kept_;
  std::ofstream log_;
};

}  // namespace presa::temple
