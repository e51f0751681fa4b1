#pragma once
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "apps/experiment/session_log.h"
#include "experiments/runner/definition/definition.h"

namespace presa::experiment::analysis {

/// Outcome counts of the trials of one session. Practice counts in `practice` only.
struct SessionCensus {
  SessionFolder folder;
  std::string subject, model;  ///< model: empty for a person
  int session = 1;
  bool complete = false;
  std::size_t planned = 0, counted = 0, excluded = 0;
  std::size_t missing = 0;               ///< planned but never completed: given up, skipped or not yet run
  std::size_t aborted = 0, cut_off = 0;  ///< runs aborted by a rule; runs interrupted
  std::size_t practice = 0;              ///< practice runs
};

/// A trial that does not count, with the reason.
struct LeftOut {
  std::string subject;
  int session = 1, trial = 0;
  std::string what, why;  ///< what: "excluded" or "missing"
};

/// Whether a trial of a subject takes part.
using TrialChoice = std::function<bool(const std::string& subject, int trial)>;

/// The trials of all sessions that count, one row each; practice and excluded trials are left out.
struct Trials {
  struct Row {
    std::size_t subject = 0;  ///< index into `subjects`
    std::size_t session = 0;  ///< index into `sessions`
    int number = 0, block = 0;
    std::string file;  ///< its recording; with two intervals that of the first
    Json phases;       ///< begin and end of each phase in that recording [s]
  };
  std::vector<std::string> subjects;
  std::vector<SessionCensus> sessions;
  std::vector<LeftOut> left_out;
  std::vector<Row> rows;
  std::map<std::string, std::vector<double>> numbers;      ///< by name and row; NaN: no value
  std::map<std::string, std::vector<std::string>> labels;  ///< the same as text, levels spelled as in the file

  std::size_t size() const noexcept { return rows.size(); }
  /// Description of the model that simulated the subjects; empty when all subjects are people.
  std::string model() const;
  /// The rows that have a value for all of `names`.
  std::vector<std::size_t> complete(const std::vector<std::string>& names) const;
  std::vector<double> numbersOf(const std::string& name, const std::vector<std::size_t>& of) const;
  std::vector<int> subjectsOf(const std::vector<std::size_t>& of) const;
  /// Leaves the rows of these trials.
  void keep(const TrialChoice& chosen);
};

/// Trials that share the levels of the grouping variables.
struct Group {
  std::vector<std::string> levels;
  std::vector<std::size_t> rows;
};
/// Groups of the rows `of` by the levels of `names`: levels in the order of the factor, numbers ascending. Without
/// names all rows form one group.
std::vector<Group> groupsBy(const Experiment& experiment, const Trials& trials, const std::vector<std::string>& names,
                            const std::vector<std::size_t>& of);

struct SessionData {
  SessionFolder folder;
  SessionLog log;
};
/// The sessions below `data`, read from their logs. Throws InputError: E945 no session found, E946 sessions of several
/// experiments, E92x a damaged log.
std::vector<SessionData> readSessions(const std::string& data);
Trials trialsOf(const Experiment& experiment, const std::vector<SessionData>& sessions);

}  // namespace presa::experiment::analysis
