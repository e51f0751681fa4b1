#pragma once
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <string>

#include "apps/experiment/session_log.h"
#include "experiments/runner/definition/order.h"
#include "experiments/runner/definition/read.h"

namespace presa::experiment {

/// Numbers of one trial by name; NaN: no value.
using TrialValues = std::map<std::string, double>;

/// A dataset with invented numbers in the format of real sessions: journal and definition, no recordings.
class SyntheticDataset {
 public:
  /// `definition`: text of an experiment file.
  SyntheticDataset(std::string folder, std::string definition)
      : folder_(std::move(folder)), definition_(std::move(definition)) {}

  struct Made {
    TrialValues values;
    Outcome outcome = Outcome::kDone;
    std::string reason{}, excluded{};
  };
  using Make = std::function<Made(const Experiment&, const PlannedTrial&)>;

  /// Adds a session of a subject with the trials of the plan; `runs`: only the first ones, which leaves it unfinished.
  void addSession(int subject, const Make& make, std::size_t runs = SIZE_MAX, const std::string& model = {}) {
    const std::string id = "S0" + std::to_string(subject);
    const SessionFolder at = folderOf(folder_, id, 1);
    std::filesystem::create_directories(at.path);
    std::ofstream(at.file("experiment.xml")) << definition_;
    Diagnostics diagnostics;
    const auto experiment = readRecorded(at.file("experiment.xml"), diagnostics);
    if (!experiment) throw std::runtime_error(diagnostics.text());
    Journal journal = Journal::create(at.journal());
    SessionStart who;
    who.experiment_file = at.file("experiment.xml");
    who.subject = {id, subject};
    who.model = model;
    Json start = toJson(who);
    start["experiment"] = experiment->name;
    journal.append(start);
    for (const PlannedTrial& trial : planTrials(*experiment, subject, 1)) {
      if (runs-- == 0) return;
      append(journal, *experiment, trial, make(*experiment, trial));
    }
    journal.append({{"event", "end"}});
  }
  const std::string& folder() const { return folder_; }

 private:
  static void append(Journal& journal, const Experiment& experiment, const PlannedTrial& trial, const Made& made) {
    Json condition = Json::object(), values = Json::object();
    for (const Factor& factor : experiment.factors) {
      for (const Column& column : factor.columns) {
        const std::string text = experiment.valueOf(column.name, trial.condition);
        condition[column.name] = text;
        values[column.name] = std::stod(text);
      }
    }
    for (const auto& [name, value] : made.values) values[name] = std::isfinite(value) ? Json(value) : Json(nullptr);
    journal.append({{"event", "trial_begin"},
                    {"trial", trial.number},
                    {"practice", trial.practice},
                    {"block", trial.block},
                    {"repeat", trial.repeat},
                    {"attempt", 1},
                    {"run", 1},
                    {"condition", condition},
                    {"seed", "1"},
                    {"files", {"none.h5"}}});
    journal.append({{"event", "trial_end"},
                    {"outcome", toString(made.outcome)},
                    {"reason", made.reason},
                    {"excluded", made.excluded},
                    {"phases", Json::array()},
                    {"values", values}});
  }

  std::string folder_, definition_;
};

}  // namespace presa::experiment
