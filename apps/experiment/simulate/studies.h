#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "apps/common/cluster/shard.h"

namespace presa::experiment {

/// Many simulated studies of an experiment, each with its own simulated subjects, to plan the real study.
struct StudiesPlan {
  std::string experiment_file;
  std::string level;  ///< level of the simulated subjects; empty: the rig's
  std::string rig_file;
  int subjects = 3, studies = 1;
  double power = 0.8;       ///< wanted
  int jobs = 0;             ///< parallel sessions; 0: one per processor
  cluster::Shard shard{};   ///< the sessions that this machine runs
  bool recordings = false;  ///< record every haptic tick
  std::string out;
};

/// One session of a study, in OUT/study-NNN/sub-NN/ses-1.
struct StudySession {
  int study = 0, subject = 0;
  std::string data;  ///< folder of the study
  std::string subject_id;
  std::uint64_t seed = 0;  ///< seed of the experiment in this study
};

/// All sessions of this shard. Study k (from 0) has the seed `first_seed` + k.
std::vector<StudySession> sessionsOf(const StudiesPlan& plan, std::uint64_t first_seed);

struct StudiesOutcome {
  std::size_t complete = 0, found = 0;  ///< `found`: complete before this call
  std::vector<std::string> failed;      ///< last output of each failed session
  bool interrupted = false;
};

/// Runs the incomplete sessions, each in its own process so that a failure stays isolated. Interrupted sessions are
/// resumed. Progress goes to stderr; Ctrl-C stops, and the same command continues later.
StudiesOutcome runStudies(const StudiesPlan& plan, const std::vector<StudySession>& sessions);

}  // namespace presa::experiment
