#include "apps/experiment/operator/operator_console.h"

#include <algorithm>
#include <cmath>

#include "apps/common/terminal/text.h"
#include "apps/experiment/dry_run.h"
#include "experiments/runner/definition/presentation.h"
#include "framework/core/schedule/clock.h"

namespace presa::experiment {
namespace {

using terminal::format;

std::string conditionText(const Experiment& experiment, const PlannedTrial& trial) {
  std::string text;
  const std::vector<Column> columns = experiment.columns();
  const Presentation shown = presentationsOf(experiment, trial).back();
  for (std::size_t i = 0; i < columns.size(); ++i)
    text += format("%s %.4g %s  ", columns[i].name.c_str(), shown.columns[i], columns[i].unit.c_str());
  return text;
}

}  // namespace

OperatorConsole::OperatorConsole(const Experiment& experiment, const SessionStart& start, std::string language,
                                 Operator& person, ParticipantDesk& desk, std::function<void(const std::string&)> note)
    : experiment_(experiment),
      start_(start),
      language_(std::move(language)),
      person_(person),
      desk_(desk),
      note_(std::move(note)),
      begin_ns_(monotonicNs()),
      min_duration_(durationOf(experiment).min) {
  view_.title = experiment.title.empty() ? experiment.name : experiment.title;
  view_.subject = start.subject.id;
  view_.session = start.session;
  view_.model = start.model;
  person.listenTo([&desk] { return desk.key(); });
}

OperatorConsole::~OperatorConsole() { person_.listenTo({}); }

double OperatorConsole::secondsLeft(double time) const {
  const auto left = static_cast<double>(view_.left);
  if (ended_ > 0) return std::max(0.0, left * each_ - (start_.realtime ? time : 0));
  return start_.realtime ? left * min_duration_ - time : -1;
}

bool OperatorConsole::welcome() {
  const std::string instruction = experiment_.textFor("start", language_);
  if (person_.silent() || !start_.model.empty() || instruction.empty()) return true;
  desk_.tell("start");
  const Request request = person_.await("\"" + instruction + "\"", 0);
  desk_.leave();
  return request != Request::kStop;
}

void OperatorConsole::begin(const PlannedTrial& trial, const TrialSource& source) {
  view_.trial = trial.number;
  view_.block = trial.block;
  view_.attempt = trial.attempt;
  view_.practice = practice_ = trial.practice;
  view_.done = source.done();
  view_.left = source.left();
  view_.missing = source.missing();
  view_.condition = conditionText(experiment_, trial);
  view_.answers.clear();
  if (const auto* method = source.method()) view_.answers = method->trials();
  if (experiment_.watch) {
    const Watch& watch = *experiment_.watch;
    view_.watch = {watch.name, watch.unit, 0, std::nan(""), watch.max};
    if (watch.line) view_.watch.line = watch.line->evaluate(presentationsOf(experiment_, trial).back().columns);
  }
  ending_ = Request::kNone;
  view_.asked.clear();
}

void OperatorConsole::look(double time) {
  view_.seconds_left = secondsLeft(time);
  if (live() != nullptr) {
    const Phase& phase = experiment_.phases[live_.phase];
    view_.phase = phase.name;
    view_.phase_limit = phase.seconds;
    view_.phase_time = std::max(0.0, live_.time - live_.phase_begin);
    view_.instruction = experiment_.textFor(phase.name, language_);
    view_.watch.value = live_.watch;
    view_.device_lost = live_.device_lost;
    view_.clipped = live_.clipped;
    view_.fingers.clear();
    for (std::size_t f = 0; f < live_.roles.size(); ++f)
      view_.fingers.push_back({live_.roles[f], static_cast<ContactMode>(live_.mode[f].load()), live_.force[f]});
  }
  person_.show(view_);
  take();
}

void OperatorConsole::take() {
  if (const auto note = person_.takeNote()) {
    note_(*note);
    ++view_.notes;
  }
  const Request request = person_.request();
  if (request == Request::kPause) pause_ = !pause_;
  if (pause_) view_.asked = "pause after this trial";
  if (request != Request::kNone && request != Request::kPause) ending_ = request;
}

bool OperatorConsole::between(const std::string& what, const TrialSource& source) {
  ++ended_;
  each_ = static_cast<double>(monotonicNs() - begin_ns_) * 1e-9 / static_cast<double>(ended_);
  person_.ended(what);
  view_.last = what;
  view_.done = source.done();
  view_.left = source.left();
  if (source.left() == 0 || person_.silent()) return ending_ != Request::kStop;
  since_rest_ += practice_ ? 0 : 1;
  const int every = experiment_.rest.every;
  const bool rests = start_.realtime && every > 0 && since_rest_ >= static_cast<std::size_t>(every);
  if (!pause_ && !rests) return ending_ != Request::kStop;
  if (rests) since_rest_ = 0;
  if (rests) desk_.tell("rest");
  const std::string instruction = rests ? experiment_.textFor("rest", language_) : "";
  const Request request =
      person_.await(rests ? "rest   \"" + instruction + "\"" : "paused", rests ? experiment_.rest.seconds : 0);
  desk_.leave();
  if (const auto note = person_.takeNote()) note_(*note);
  pause_ = false;
  return request != Request::kStop;
}

}  // namespace presa::experiment
