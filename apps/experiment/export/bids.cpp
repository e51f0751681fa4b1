#include "apps/experiment/export/bids.h"

#include <algorithm>
#include <map>

#include "apps/common/version.h"
#include "apps/experiment/export/bids_session.h"
#include "apps/experiment/export/cells.h"

namespace presa::experiment {
namespace {

using BySubject = std::map<std::string, std::vector<const SourceSession*>>;

BySubject bySubject(const std::vector<SourceSession>& sessions) {
  BySubject subjects;
  for (const SourceSession& session : sessions) subjects[session.log.start.subject.id].push_back(&session);
  return subjects;
}

/// Begin of the participant's first session [s since 1970].
std::time_t zeroOf(const std::vector<const SourceSession*>& sessions) {
  std::time_t zero = instantOf(sessions.front()->start.value("utc", ""));
  for (const SourceSession* session : sessions) zero = std::min(zero, instantOf(session->start.value("utc", "")));
  return zero;
}

bool anyModel(const std::vector<SourceSession>& sessions) {
  return std::any_of(sessions.begin(), sessions.end(), [](const SourceSession& one) { return !one.model().empty(); });
}

void writeDescription(const std::vector<SourceSession>& sessions, const BidsOptions& options, const StagedFolder& out) {
  Json description{{"Name", sessions.front().title},
                   {"BIDSVersion", kBidsVersion},
                   {"DatasetType", "raw"},
                   {"License", options.license.empty() ? "none stated: ask the authors before use" : options.license}};
  if (!options.authors.empty()) description["Authors"] = options.authors;
  description["GeneratedBy"] = Json::array({{{"Name", "Presa"}, {"Version", kVersion}}});
  out.write("dataset_description.json", text(description));
}

void writeReadme(const std::vector<SourceSession>& sessions, const StagedFolder& out) {
  std::string readme = sessions.front().title + "\n\n";
  if (anyModel(sessions))
    readme +=
        "Participants whose column `model` in participants.tsv is not n/a are models, not people.\n"
        "Nothing in this dataset about them is a finding about people.\n\n";
  readme +=
      "Recorded and exported by Presa. In every session:\n"
      "- beh/: one row for each run of a trial that ended: condition, measures, quality. The json beside it\n"
      "  explains each column and gives its unit. Trials that count: outcome done, practice 0, excluded n/a.\n"
      "- motion/: every haptic tick of each run: fingertips and bodies in metres, forces in newtons (channels of\n"
      "  type MISC), and the phases of the trial as events. Column motion_run of beh/ gives the index of the file.\n"
      "- sessions.tsv: the SHA-256 that seals the log of the session, from which all of this was made.\n"
      "Dates are shifted; pseudonyms stand for participants. sourcedata/ holds experiment, scene and rig as they "
      "ran.\n";
  out.write("README", readme);
  out.write("sourcedata/README",
            "Experiment, scene and rig of each session, with every default; paths from the experiment.\n");
}

void writeParticipants(const BySubject& subjects, const StagedFolder& out) {
  Tsv table({"participant_id", "species", "model", "number"});
  for (const auto& [id, sessions] : subjects) {
    const SourceSession& first = *sessions.front();
    const bool person = first.model().empty();
    table.add({"sub-" + id, person ? "homo sapiens" : kNothing, person ? kNothing : first.model(),
               std::to_string(first.log.start.subject.number)});
  }
  out.write("participants.tsv", table.text());
  out.write("participants.json",
            text({{"participant_id", {{"Description", "pseudonym"}}},
                  {"species", {{"Description", "n/a for a model"}}},
                  {"model", {{"Description", "n/a for a person; else what held the devices: a model, not a person"}}},
                  {"number", {{"Description", "of the participant in the experiment's design"}}}}));
}

void writeSessions(const std::string& id, const std::vector<const SourceSession*>& sessions, const StagedFolder& out) {
  Tsv table({"session_id", "finished", "trial_runs", "interrupted", "seed", "presa", "seal"});
  for (const SourceSession* session : sessions) {
    const auto& runs = session->log.runs;
    const auto done = std::count_if(runs.begin(), runs.end(), ended);
    table.add({"ses-" + std::to_string(session->log.start.session), session->log.complete ? "1" : "0",
               std::to_string(done), std::to_string(static_cast<std::ptrdiff_t>(runs.size()) - done),
               session->start.at("seed").dump(), session->start.value("presa", ""), session->seal});
  }
  const std::string base = "sub-" + id + "/sub-" + id + "_sessions";
  out.write(base + ".tsv", table.text());
  out.write(
      base + ".json",
      text({{"finished", {{"Description", "0: trials are still to come"}}},
            {"trial_runs", {{"Description", "runs of trials that ended: the rows in beh"}}},
            {"interrupted", {{"Description", "runs that were cut off; they came again and are not exported"}}},
            {"seed", {{"Description", "of the experiment: order and every random stream"}}},
            {"presa", {{"Description", "version that began the session"}}},
            {"seal",
             {{"Description", "SHA-256 over the chain of the session's log; presa experiment validate shows it"}}}}));
}

}  // namespace

bool exportBids(const std::vector<SourceSession>& sessions, const std::string& out, const BidsOptions& options,
                const Continue& more) {
  StagedFolder folder(out);
  const BySubject subjects = bySubject(sessions);
  writeDescription(sessions, options, folder);
  writeReadme(sessions, folder);
  writeParticipants(subjects, folder);
  for (const auto& [id, of_subject] : subjects) {
    const std::time_t zero = zeroOf(of_subject);
    writeSessions(id, of_subject, folder);
    for (const SourceSession* session : of_subject) {
      if (!BidsSession(*session, zero, folder).write(more)) return false;
    }
  }
  folder.publish();
  return true;
}

}  // namespace presa::experiment
