#include "apps/temple/visit_log.h"

#include <cerrno>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>

#include "apps/common/atomic_file.h"

namespace presa::temple {
namespace {

using Json = nlohmann::ordered_json;
using Kind = GuideEvent::Kind;

const char* wordOf(Kind kind) {
  switch (kind) {
    case Kind::kTaken:
      return "taken";
    case Kind::kPlaced:
      return "placed";
    case Kind::kUndone:
      return "undone";
    case Kind::kDropped:
      return "dropped";
    case Kind::kBlocked:
      return "blocked";
    case Kind::kHint:
      return "hint";
    case Kind::kFinished:
      break;
  }
  return "finished";
}

double rounded(double seconds) { return std::round(1e3 * seconds) / 1e3; }

}  // namespace

VisitLog::VisitLog(const std::string& folder, KeptSession base, const Scene& scene, const std::string& language,
                   const std::string& guide)
    : scene_(scene), file_(sessionFile(folder)), kept_(std::move(base)) {
  std::filesystem::create_directories(folder);
  removeHalfWritten(folder);
  const std::string file = logFile(folder);
  log_.open(file, std::ios::app);
  if (!log_) throw std::system_error(errno, std::generic_category(), file);
  write(Json{{"event", "start"},
             {"size", kept_.size},
             {"seed", kept_.seed},
             {"language", language},
             {"guide", guide},
             {"placed", kept_.placed},
             {"spent_s", rounded(kept_.elapsed)}}
            .dump());
}

void VisitLog::write(const std::string& line) { log_ << line << '\n' << std::flush; }

void VisitLog::note(const std::string& event, double time) {
  write(Json{{"event", event}, {"time_s", rounded(time)}, {"placed", kept_.placed}}.dump());
}

void VisitLog::note(const std::vector<GuideEvent>& events, const VisitObserver::Snapshot& snapshot) {
  bool changed = false;
  for (const GuideEvent& event : events) {
    Json line{{"event", wordOf(event.kind)}, {"time_s", rounded(event.time)}};
    if (event.goal != kNoGoal) line["goal"] = scene_.assembly->goals[static_cast<std::size_t>(event.goal)].name;
    if (event.body != kNoBody) line["body"] = scene_.bodies[static_cast<std::size_t>(event.body)].name;
    if (event.kind == Kind::kFinished) line["spent_s"] = rounded(snapshot.now.elapsed);
    line["placed"] = snapshot.now.placed;
    write(line.dump());
    changed = changed || event.kind == Kind::kPlaced || event.kind == Kind::kUndone;
  }
  if (changed) keep(snapshot);
}

void VisitLog::note(const std::vector<HelpNote>& notes) {
  for (const HelpNote& note : notes)
    write(Json{{"event", "help"},
               {"time_s", rounded(note.time)},
               {"strength", rounded(note.strength)},
               {"grasp_off_m", rounded(note.need.grasp)},
               {"place_off_m", rounded(note.need.place)},
               {"own", note.own},
               {"placed", kept_.placed}}
              .dump());
}

void VisitLog::keep(const VisitObserver::Snapshot& snapshot) {
  kept_.elapsed = snapshot.now.elapsed;
  kept_.placed = snapshot.now.placed;
  // the blocks are the scene's first bodies
  std::copy_n(snapshot.X_WB.begin(), kept_.X_WB.size(), kept_.X_WB.begin());
  if (snapshot.now.finished) {
    std::filesystem::remove(file_);  // finished: nothing to continue
    return;
  }
  writeFileAtomically(file_, keptText(kept_));
}

}  // namespace presa::temple
