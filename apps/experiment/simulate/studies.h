#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace presa::experiment {

/// Many studies of an experiment, each with simulated subjects of its own: what to expect before any person comes.
struct StudiesPlan {
  std::string experiment_file;
  std::string level;  ///< of the simulated subjects; empty: as the rig says
  std::string rig_file;
  int subjects = 3, studies = 1;
  int jobs = 0;               ///< sessions at once; 0: one per processor
  int shard = 1, shards = 1;  ///< this machine runs every `shards`-th session, from `shard` on
  bool recordings = false;    ///< keep every haptic tick too
  std::string out;
};

/// One session of them, in OUT/study-NNN/sub-NN/ses-1.
struct StudySession {
  int study = 0, subject = 0;
  std::string data;  ///< folder of the study
  std::string subject_id;
  std::uint64_t seed = 0;  ///< of the experiment in this study
};

/// All sessions of this shard. The first study has the experiment's own seed, the next ones those after it.
std::vector<StudySession> sessionsOf(const StudiesPlan& plan, std::uint64_t first_seed);

struct StudiesOutcome {
  std::size_t complete = 0, found = 0;  ///< `found`: complete already before
  std::vector<std::string> failed;      ///< what each said at its end
  bool interrupted = false;
};

/// Runs what is not complete yet, each session in a process of its own so that one that fails takes no other with it. A session that
/// was cut off is resumed. Progress on stderr; Ctrl-C stops, the same command goes on.
StudiesOutcome runStudies(const StudiesPlan& plan, const std::vector<StudySession>& sessions);

}  // namespace presa::experiment
