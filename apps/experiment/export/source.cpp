#include "apps/experiment/export/source.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>

#include "apps/common/delimited.h"
#include "apps/common/file_text.h"
#include "apps/experiment/dataset.h"
#include "framework/core/diagnostics/refuse.h"
#include "framework/record/checksum/checksum.h"
#include "framework/scene/xml/xml.h"

namespace presa::experiment {
namespace {

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

/// Splits a heading such as "mass [kg]" into name and unit.
SourceColumn columnOf(const std::string& heading, const Json& described) {
  const auto unit = described.value("Units", "");
  const std::string tail = unit.empty() ? "" : " [" + unit + "]";
  const bool has_tail = !tail.empty() && heading.ends_with(tail);
  return {heading.substr(0, heading.size() - (has_tail ? tail.size() : 0)), unit, described.value("Description", "")};
}

void readTable(SourceSession& session) {
  const std::string text = contentsOf(session.folder.file("trials.csv"));
  const auto records = recordsOf(text, ',');
  const Json described = Json::parse(contentsOf(session.folder.file("trials.json")));
  if (records.empty() || records.size() != session.log.runs.size() + 1)
    refuse(931, session.folder.file("trials.csv"), "does not hold one row for each run in the log",
           "presa experiment resume writes it anew");
  for (const std::string& heading : records.front().cells)
    session.columns.push_back(columnOf(heading, described.value(heading, Json::object())));
  for (std::size_t i = 1; i < records.size(); ++i) session.rows.push_back(records[i].cells);
}

/// Reads title, description and instructions from the session's copy of the experiment.
void readWords(SourceSession& session) {
  Diagnostics ignored;
  const auto document = xml::Document::load(session.folder.file("experiment.xml"), ignored);
  if (!document) return;
  session.title = document->root().attribute("title", session.name());
  session.description = document->root().attribute("description", session.title);
  for (const xml::Element& text : document->root().children("text")) {
    const std::string language = text.attribute("language");
    session.instructions += (session.instructions.empty() ? "" : " | ") + text.attribute("when") +
                            (language.empty() ? "" : " (" + language + ")") + ": " + text.attribute("text");
  }
}

bool hasTrial(const SessionLog& log) { return std::any_of(log.runs.begin(), log.runs.end(), ended); }

/// Checks the logged checksums of the files other than recordings.
void checkDocuments(const SourceSession& session) {
  for (const Json& record : {session.start, session.end}) {
    if (!record.is_object() || !record.contains("sha256")) continue;
    for (const auto& [name, sum] : record.at("sha256").items()) checkUnaltered(session.folder, name, sum);
  }
}

SourceSession read(const SessionFolder& folder, const Journal::Contents& contents) {
  SourceSession session{.folder = folder,
                        .log = readLog(folder.journal(), contents.records),
                        .start = contents.records.front(),
                        .seal = contents.sum};
  if (session.log.complete) session.end = contents.records.back();
  checkDocuments(session);
  readWords(session);
  readTable(session);
  return session;
}

/// Refuses sessions whose file names would collide, also on file systems that ignore case.
void checkNames(const std::vector<SourceSession>& sessions) {
  std::map<std::string, const SourceSession*> taken;
  std::map<std::string, std::string> subjects;
  for (const SourceSession& session : sessions) {
    const auto [other, is_new] = taken.try_emplace(lower(session.prefix()), &session);
    const auto [id, first] = subjects.try_emplace(lower(session.log.start.subject.id), session.log.start.subject.id);
    if (!is_new || id->second != session.log.start.subject.id)
      refuse(932, session.folder.path,
             "would get the names of " + (is_new ? "sub-" + id->second : other->second->folder.path),
             "export one experiment at a time");
  }
}

}  // namespace

std::string SourceSession::prefix() const {
  return "sub-" + log.start.subject.id + "_ses-" + std::to_string(log.start.session);
}

std::vector<std::string> SourceSession::recordings(const LoggedRun& run) const {
  std::vector<std::string> there;
  if (!ended(run) || !run.end.contains("sha256")) return there;
  for (const std::string& name : run.files()) {
    if (run.end.at("sha256").contains(name)) there.push_back(name);
  }
  return there;
}

void checkUnaltered(const SessionFolder& folder, const std::string& name, const std::string& sum) {
  const char* const help = "presa experiment validate tells all that was changed";
  if (!std::filesystem::exists(folder.file(name))) refuse(931, folder.file(name), "is missing", help);
  if (sha256OfFile(folder.file(name)) != sum) refuse(931, folder.file(name), "is not what was recorded", help);
}

bool ended(const LoggedRun& run) { return run.end.is_object() && run.outcome != Outcome::kInterrupted; }

std::vector<SourceSession> sourceSessions(const std::string& data) {
  std::vector<SourceSession> sessions;
  for (const SessionFolder& folder : sessionsIn(data)) {
    const Journal::Contents contents = Journal::read(folder.journal());
    if (contents.records.empty() || !hasTrial(readLog(folder.journal(), contents.records))) continue;
    sessions.push_back(read(folder, contents));
  }
  if (sessions.empty()) refuse(930, data, "holds no session with a trial that ended");
  checkNames(sessions);
  std::sort(sessions.begin(), sessions.end(), [](const SourceSession& a, const SourceSession& b) {
    return std::pair(a.log.start.subject.id, a.log.start.session) <
           std::pair(b.log.start.subject.id, b.log.start.session);
  });
  return sessions;
}

}  // namespace presa::experiment
