#pragma once
#include <map>
#include <string>
#include <vector>

#include "apps/experiment/session_log.h"
#include "experiments/runner/definition/definition.h"

namespace presa::experiment::analysis {

/// What became of the trials of one session; practice is left out of every number but its own.
struct SessionCensus {
  SessionFolder folder;
  std::string subject, model;  ///< model: empty for a person
  int session = 1;
  bool complete = false;
  std::size_t planned = 0, counted = 0, excluded = 0;
  std::size_t missing = 0;               ///< planned and never done: given up, skipped or not yet run
  std::size_t aborted = 0, cut_off = 0;  ///< runs that were aborted by a rule, or interrupted
  std::size_t practice = 0;              ///< runs
};

/// A trial that does not count, and why.
struct LeftOut {
  std::string subject;
  int session = 1, trial = 0;
  std::string what, why;  ///< what: "excluded" or "missing"
};

/// The trials that count, of all sessions: one row each, practice and excluded ones left out.
struct Trials {
  struct Row {
    std::size_t subject = 0;  ///< index into `subjects`
    std::size_t session = 0;  ///< index into `sessions`
    int number = 0, block = 0;
    std::string file;  ///< its recording; of two intervals the first
    Json phases;       ///< begin and end of each [s], of the same
  };
  std::vector<std::string> subjects;
  std::vector<SessionCensus> sessions;
  std::vector<LeftOut> left_out;
  std::vector<Row> rows;
  std::map<std::string, std::vector<double>> numbers;      ///< by name and row; NaN: none
  std::map<std::string, std::vector<std::string>> labels;  ///< the same as words, levels as the file writes them

  std::size_t size() const noexcept { return rows.size(); }
  /// What simulated the subjects, in words; empty when all are people.
  std::string model() const;
  /// The rows for which all these numbers are there.
  std::vector<std::size_t> complete(const std::vector<std::string>& names) const;
  std::vector<double> numbersOf(const std::string& name, const std::vector<std::size_t>& of) const;
  std::vector<int> subjectsOf(const std::vector<std::size_t>& of) const;
};

/// Trials with the same levels of some names.
struct Group {
  std::vector<std::string> levels;
  std::vector<std::size_t> rows;
};
/// Groups of `of`, in the order of the factors' levels, numbers by size. No names: one group of all.
std::vector<Group> groupsBy(const Experiment& experiment, const Trials& trials, const std::vector<std::string>& names,
                            const std::vector<std::size_t>& of);

struct SessionData {
  SessionFolder folder;
  SessionLog log;
};
/// The sessions below `data`, read from their logs. Throws InputError: E945 there is none, E946 they are of several
/// experiments, E92x a log is damaged.
std::vector<SessionData> readSessions(const std::string& data);
Trials trialsOf(const Experiment& experiment, const std::vector<SessionData>& sessions);

}  // namespace presa::experiment::analysis
