#include "apps/experiment/analysis/trials.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "apps/experiment/dataset.h"
#include "experiments/runner/definition/order.h"
#include "framework/core/diagnostics/refuse.h"
#include "framework/scene/xml/value_rule.h"

namespace presa::experiment::analysis {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

double numberOf(const std::string& text) {
  double value = 0;
  return xml::readNumber(text, value) == xml::NumberKind::kFinite ? value : kNothing;
}

bool isDone(const LoggedRun& run) { return run.outcome == Outcome::kDone && !run.practice; }

/// Fills the table of trials run by run.
class Collector {
 public:
  Collector(const Experiment& experiment, Trials& trials) : experiment_(experiment), trials_(trials) {
    for (const Variable& variable : variablesOf(experiment)) {
      trials.numbers[variable.name];
      trials.labels[variable.name];
    }
  }

  void take(const SessionData& session) {
    const SessionStart& start = session.log.start;
    const auto known = std::find(trials_.subjects.begin(), trials_.subjects.end(), start.subject.id);
    subject_ = static_cast<std::size_t>(known - trials_.subjects.begin());
    if (known == trials_.subjects.end()) trials_.subjects.push_back(start.subject.id);
    trials_.sessions.push_back(censusOf(session));
    SessionCensus& census = trials_.sessions.back();
    std::set<int> done;
    for (const LoggedRun& run : session.log.runs) {
      if (!isDone(run)) continue;
      done.insert(run.number);
      const std::string excluded = run.end.value("excluded", "");
      if (excluded.empty())
        add(run, census);
      else
        leaveOut(census, run.number, "excluded", excluded);
    }
    census.excluded = done.size() - census.counted;
    findMissing(session, done, census);
  }

 private:
  SessionCensus censusOf(const SessionData& session) const {
    const SessionStart& start = session.log.start;
    SessionCensus census{session.folder, start.subject.id, start.model, start.session, session.log.complete};
    for (const LoggedRun& run : session.log.runs) {
      if (run.practice) {
        ++census.practice;
      } else {
        census.aborted += run.outcome == Outcome::kAborted ? 1 : 0;
        census.cut_off += run.outcome == Outcome::kInterrupted ? 1 : 0;
      }
    }
    return census;
  }

  void leaveOut(const SessionCensus& census, int trial, const char* what, const std::string& why) {
    trials_.left_out.push_back({census.subject, census.session, trial, what, why});
  }

  void findMissing(const SessionData& session, const std::set<int>& done, SessionCensus& census) {
    std::map<int, std::string> why;  // state of each trial that was begun or planned
    const SessionStart& start = session.log.start;
    if (!experiment_.procedure) {  // with a procedure the number of trials is not known in advance
      for (const PlannedTrial& trial : planTrials(experiment_, start.subject.number, start.session)) {
        if (!trial.practice) why[trial.number] = census.complete ? "never begun" : "not run yet";
      }
    }
    for (const LoggedRun& run : session.log.runs) {
      if (run.practice) continue;
      const std::string reason = run.end.is_object() ? run.end.value("reason", "") : "the process ended";
      why[run.number] = std::string(toString(run.outcome)) + (reason.empty() ? "" : ": " + reason);
    }
    census.planned = why.size();
    for (const auto& [trial, reason] : why) {
      if (done.contains(trial)) continue;
      ++census.missing;
      leaveOut(census, trial, "missing", reason);
    }
  }

  void add(const LoggedRun& run, SessionCensus& census) {
    ++census.counted;
    const Json& begin = run.begin;
    const Json phases = run.end.value("phases", Json::array());
    const std::vector<std::string> files = run.files();
    trials_.rows.push_back({subject_, trials_.sessions.size() - 1, run.number, begin.value("block", 0),
                            files.empty() ? std::string() : census.folder.file(files.front()),
                            phases.empty() ? Json::object() : phases.front()});
    for (auto& [name, values] : trials_.numbers) {
      const std::string label = labelOf(run, name, census.session);
      values.push_back(numberOf(label));
      trials_.labels[name].push_back(label);
    }
  }

  static std::string labelOf(const LoggedRun& run, const std::string& name, int session) {
    if (name == "session") return std::to_string(session);
    for (const auto& [where, part] : {std::pair{&run.begin, "condition"}, {&run.end, "values"}}) {
      const auto found = where->find(part);
      if (found == where->end() || !found->contains(name)) continue;
      const Json& value = (*found)[name];
      return value.is_string() ? value.get<std::string>() : value.is_null() ? std::string() : value.dump();
    }
    const auto place = run.begin.find(name);
    return place == run.begin.end() || place->is_structured() ? std::string() : place->dump();
  }

  const Experiment& experiment_;
  Trials& trials_;
  std::size_t subject_ = 0;
};

/// The levels of a name in the order in which they are reported.
std::vector<std::string> levelsOf(const Experiment& experiment, const Trials& trials, const std::string& name) {
  std::vector<std::string> all;
  const auto add = [&](const std::string& level) {
    if (std::find(all.begin(), all.end(), level) == all.end()) all.push_back(level);
  };
  for (const Factor& factor : experiment.factors) {
    for (std::size_t c = 0; c < factor.columns.size(); ++c) {
      if (factor.columns[c].name != name) continue;
      for (const auto& level : factor.levels) add(level[c]);
    }
  }
  const auto designed = static_cast<std::ptrdiff_t>(all.size());
  for (const std::string& label : trials.labels.at(name)) add(label);
  std::sort(all.begin() + designed, all.end(), [](const std::string& a, const std::string& b) {
    const double x = numberOf(a), y = numberOf(b);
    return std::isnan(x) || std::isnan(y) ? a < b : x < y;
  });
  return all;
}

}  // namespace

std::string Trials::model() const {
  std::set<std::string> models;
  for (const SessionCensus& session : sessions) {
    if (!session.model.empty()) models.insert(session.model);
  }
  std::string all;
  for (const std::string& model : models) all += (all.empty() ? "" : "; ") + model;
  return all;
}

std::vector<std::size_t> Trials::complete(const std::vector<std::string>& names) const {
  std::vector<std::size_t> found;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const auto there = [&](const std::string& name) { return std::isfinite(numbers.at(name)[row]); };
    if (std::all_of(names.begin(), names.end(), there)) found.push_back(row);
  }
  return found;
}

std::vector<double> Trials::numbersOf(const std::string& name, const std::vector<std::size_t>& of) const {
  std::vector<double> values;
  for (const std::size_t row : of) values.push_back(numbers.at(name)[row]);
  return values;
}

std::vector<int> Trials::subjectsOf(const std::vector<std::size_t>& of) const {
  std::vector<int> found;
  for (const std::size_t row : of) found.push_back(static_cast<int>(rows[row].subject));
  return found;
}

void Trials::keep(const TrialChoice& chosen) {
  std::vector<std::size_t> kept;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    if (chosen(subjects[rows[row].subject], rows[row].number)) kept.push_back(row);
  }
  const auto only = [&](auto& column) {
    std::remove_reference_t<decltype(column)> left;
    for (const std::size_t row : kept) left.push_back(std::move(column[row]));
    column = std::move(left);
  };
  only(rows);
  for (auto& [name, column] : numbers) only(column);
  for (auto& [name, column] : labels) only(column);
}

std::vector<Group> groupsBy(const Experiment& experiment, const Trials& trials, const std::vector<std::string>& names,
                            const std::vector<std::size_t>& of) {
  std::vector<Group> groups{{{}, of}};
  for (const std::string& name : names) {
    std::vector<Group> finer;
    for (const Group& group : groups) {
      for (const std::string& level : levelsOf(experiment, trials, name)) {
        Group part{group.levels, {}};
        part.levels.push_back(level);
        for (const std::size_t row : group.rows) {
          if (trials.labels.at(name)[row] == level) part.rows.push_back(row);
        }
        if (!part.rows.empty()) finer.push_back(std::move(part));
      }
    }
    groups = std::move(finer);
  }
  return groups;
}

std::vector<SessionData> readSessions(const std::string& data) {
  std::vector<SessionData> sessions;
  std::string experiment;
  for (const SessionFolder& folder : sessionsIn(data)) {
    const Journal::Contents contents = Journal::read(folder.journal());
    if (contents.records.empty()) continue;  // the session never began
    const Json& start = contents.records.front();
    sessions.push_back({folder, readLog(folder.journal(), contents.records)});
    const std::string name = start.value("experiment", "");
    if (sessions.size() == 1) experiment = name;
    if (name != experiment)
      refuse(946, data,
             "holds sessions of several experiments, " + quote(experiment) + " and " + quote(name) + " among them",
             "name a folder with those of one");
  }
  if (sessions.empty()) refuse(945, data, "holds no session");
  return sessions;
}

Trials trialsOf(const Experiment& experiment, const std::vector<SessionData>& sessions) {
  Trials trials;
  Collector collector(experiment, trials);
  for (const SessionData& session : sessions) collector.take(session);
  return trials;
}

}  // namespace presa::experiment::analysis
