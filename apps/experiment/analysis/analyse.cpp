#include "apps/experiment/analysis/analyse.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include "apps/common/atomic_file.h"
#include "apps/common/terminal/text.h"
#include "apps/common/version.h"
#include "experiments/runner/definition/read.h"
#include "experiments/runner/statistics/resampling.h"
#include "framework/core/diagnostics/refuse.h"
#include "framework/record/checksum/checksum.h"

namespace presa::experiment::analysis {
namespace {

namespace fs = std::filesystem;
using terminal::format;

Experiment readDefinition(const std::string& file) {
  Diagnostics diagnostics;
  auto experiment = readRecorded(file, diagnostics);
  if (!experiment) throw InputError(diagnostics);
  if (experiment->analysis.items.empty())
    refuse(947, file, "names no analysis",
           "write one, see <analysis> in config/schema/README.md, and name the file: --experiment FILE");
  return std::move(*experiment);
}

std::vector<std::string> notesOn(const Request& request, const std::vector<SessionData>& sessions,
                                 const Trials& trials) {
  std::vector<std::string> notes;
  const std::size_t people = trials.subjects.size();
  if (people < statistics::kFewestSubjects)
    notes.push_back(format("%zu subject%s: what is found holds for %s and makes no claim about a population.", people,
                           people == 1 ? "" : "s", people == 1 ? "this one" : "these"));
  const auto open =
      std::count_if(sessions.begin(), sessions.end(), [](const auto& session) { return !session.log.complete; });
  if (open > 0)
    notes.push_back(format("%ld of %zu sessions are not finished.", static_cast<long>(open), sessions.size()));
  std::set<std::string> definitions;
  for (const SessionData& session : sessions) definitions.insert(sha256OfFile(session.folder.file("experiment.xml")));
  if (definitions.size() > 1) notes.emplace_back("The sessions were not all run with the same experiment file.");
  if (!request.experiment.empty())
    notes.push_back("The analysis is that of " + request.experiment + ", not the one that the sessions began with.");
  if (trials.size() == 0) notes.emplace_back("No trial counts: there is nothing to analyse.");
  return notes;
}

/// Leaves the sessions of the first `subjects`; 0: all.
void keepFirst(std::size_t subjects, std::vector<SessionData>& sessions) {
  std::vector<std::string> kept;
  if (subjects == 0) return;
  std::erase_if(sessions, [&](const SessionData& session) {
    const std::string& id = session.log.start.subject.id;
    const bool known = std::find(kept.begin(), kept.end(), id) != kept.end();
    if (!known && kept.size() < subjects) kept.push_back(id);
    return std::find(kept.begin(), kept.end(), id) == kept.end();
  });
}

/// Table ids are file names: repeated ids get a number.
void makeIdsDiffer(std::vector<Section>& sections) {
  std::set<std::string> taken;
  for (Section& section : sections) {
    for (Table& table : section.tables) {
      const std::string id = table.id;
      for (int i = 2; !taken.insert(table.id).second; ++i) table.id = id + "_" + std::to_string(i);
    }
  }
}

}  // namespace

std::vector<std::string> Result::headlines() const {
  std::vector<std::string> all;
  for (const Section& section : sections) {
    if (section.headline) all.insert(all.end(), section.finding.begin(), section.finding.end());
  }
  return all;
}

Result analyse(const Request& request, const Progress& progress) {
  std::vector<SessionData> sessions = readSessions(request.data);
  keepFirst(request.subjects, sessions);
  const std::string file =
      request.experiment.empty() ? sessions.front().folder.file("experiment.xml") : request.experiment;
  Experiment experiment = readDefinition(file);
  Trials trials = trialsOf(experiment, sessions);
  if (request.keeps) trials.keep(request.keeps);
  Result result{request.data, file, std::move(experiment), std::move(trials)};
  result.notes = notesOn(request, sessions, result.trials);
  if (result.trials.size() == 0) return result;
  const Context context{result.experiment, result.trials};
  const auto& items = result.experiment.analysis.items;
  progress(0, items.size(), "");
  for (const Analysis::Item& item : items) {
    Section done = std::visit([&](const auto& what) { return section(what, context); }, item.what);
    if (!item.title.empty()) done.title = item.title;
    done.headline = item.headline;
    result.sections.push_back(std::move(done));
    if (!progress(result.sections.size(), items.size(), item.kind)) {
      result.interrupted = true;
      return result;
    }
  }
  makeIdsDiffer(result.sections);
  return result;
}

std::string reportJson(const Result& result) {
  Json json{{"format", 1},
            {"presa", kVersion},
            {"experiment", result.experiment.name},
            {"analysis_file", result.analysis_file}};
  json["subjects_are"] = result.trials.model().empty() ? "persons" : result.trials.model();
  json["confidence"] = result.experiment.analysis.confidence;
  json["seed"] = result.experiment.analysis.seed;
  json["subjects"] = result.trials.subjects;
  json["trials"] = result.trials.size();
  json["notes"] = result.notes;
  for (const SessionCensus& s : result.trials.sessions)
    json["sessions"].push_back({{"subject", s.subject},
                                {"session", s.session},
                                {"complete", s.complete},
                                {"planned", s.planned},
                                {"counted", s.counted},
                                {"excluded", s.excluded},
                                {"missing", s.missing},
                                {"aborted_runs", s.aborted},
                                {"interrupted_runs", s.cut_off},
                                {"practice_runs", s.practice},
                                {"model", s.model}});
  json["left_out"] = Json::array();
  for (const LeftOut& one : result.trials.left_out)
    json["left_out"].push_back({{"subject", one.subject},
                                {"session", one.session},
                                {"trial", one.trial},
                                {"what", one.what},
                                {"why", one.why}});
  json["analyses"] = Json::array();
  for (const Section& section : result.sections) json["analyses"].push_back(jsonOf(section));
  return json.dump(2) + "\n";
}

void write(const Result& result, const std::string& out) {
  const fs::path tables = fs::path(out) / "tables";
  fs::create_directories(tables);
  for (const auto& entry : fs::directory_iterator(tables)) {
    if (entry.is_regular_file() && entry.path().extension() == ".csv") fs::remove(entry.path());
  }
  for (const Section& section : result.sections) {
    for (Table table : section.tables) {
      if (!result.trials.model().empty()) {  // a table may be read without the report that names the model
        table.columns.push_back({"subjects_are"});
        for (auto& row : table.rows) row.emplace_back(result.trials.model());
      }
      writeFileAtomically((tables / (table.id + ".csv")).string(), csvOf(table));
    }
  }
  writeFileAtomically(out + "/analysis.json", reportJson(result));
  writeFileAtomically(out + "/report.html", reportHtml(result));
}

}  // namespace presa::experiment::analysis
