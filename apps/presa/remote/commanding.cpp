#include "apps/presa/remote/commanding.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>

#include "apps/common/terminal/interruption.h"
#include "framework/bus/publisher.h"
#include "framework/core/schedule/clock.h"

namespace presa {
namespace {

constexpr std::int64_t kLookEvery = 10'000'000;   // [ns]
constexpr std::int64_t kSendEvery = 100'000'000;  // [ns] between repetitions of an unanswered command
constexpr std::int64_t kSettled = 400'000'000;    // [ns] without news, after which all runs are taken to be known

/// Keeps only the static part of a run.
class RunsOnly final : public bus::Listener {
 public:
  void onRun(const bus::RunInfo& announced, std::int64_t) override { runs.push_back(announced); }
  void onObject(const bus::ObjectSample&, std::int64_t) override {}
  void onFinger(const bus::FingerSample&, std::int64_t) override {}
  void onHeartbeat(const bus::Heartbeat&, std::int64_t) override {}
  void onEvent(const bus::Event&, std::int64_t) override {}
  std::vector<bus::RunInfo> runs;
};

std::int64_t after(double seconds) { return monotonicNs() + static_cast<std::int64_t>(seconds * 1e9); }

bool complete(const FoundRun& run) {
  return !run.info.commands ||
         (!run.parameters.empty() && run.parameters.size() >= static_cast<std::size_t>(run.parameters.front().of));
}

}  // namespace

Commanding::Commanding(const BusSettings& settings)
    : reader_(bus::openReader(settings)), commander_(bus::openCommander(settings)), sender_(bus::newRunId()) {}

void Commanding::hear() {
  RunsOnly found;
  reader_->take(found);
  for (const bus::RunInfo& info : found.runs) {
    const auto at = std::ranges::lower_bound(runs_, info.run, {}, [](const FoundRun& run) { return run.info.run; });
    if (at != runs_.end() && at->info.run == info.run) continue;
    runs_.insert(at, {info, {}});
    last_run_found_ns_ = monotonicNs();
  }
  const bus::Commander::Replies replies = commander_->take();
  answers_.insert(answers_.end(), replies.answers.begin(), replies.answers.end());
  parameters_.insert(parameters_.end(), replies.parameters.begin(), replies.parameters.end());
  for (FoundRun& run : runs_) {
    for (const bus::OpenParameter& parameter : parameters_) {
      if (parameter.run != run.info.run) continue;
      const auto at = std::ranges::lower_bound(run.parameters, parameter.name, {}, &bus::OpenParameter::name);
      if (at != run.parameters.end() && at->name == parameter.name)
        *at = parameter;
      else
        run.parameters.insert(at, parameter);
    }
    std::erase_if(parameters_, [&](const bus::OpenParameter& parameter) { return parameter.run == run.info.run; });
  }
}

const std::vector<FoundRun>& Commanding::look(double wait, std::uint64_t id) {
  const std::int64_t end = after(wait);
  const auto there = [&](const FoundRun& run) { return id == 0 || run.info.run == id; };
  for (;;) {
    hear();
    const bool settled = id != 0 || monotonicNs() - last_run_found_ns_ > kSettled;
    if (std::ranges::any_of(runs_, there) && std::ranges::all_of(runs_, complete) && settled) break;
    if (monotonicNs() >= end || terminal::Interruption::came()) break;
    sleepUntilNs(monotonicNs() + kLookEvery);
  }
  return runs_;
}

std::optional<bus::Answer> Commanding::set(std::uint64_t run, const std::string& parameter, double value, double wait) {
  bus::Command command{run, sender_, ++sent_, parameter, value};
  bool renamed = false;
  const std::int64_t end = after(wait);
  std::int64_t send_at = 0;
  for (;;) {
    if (monotonicNs() >= send_at) {
      commander_->send(command);
      send_at = monotonicNs() + kSendEvery;
    }
    hear();
    const auto answer = std::ranges::find_if(answers_, [&](const bus::Answer& to) {
      return to.run == run && to.sender == sender_ && to.number == command.number;
    });
    if (answer != answers_.end()) {
      // with one command at a time, this answer means that another sender uses the same id: try again with a new id
      const bool disturbed =
          answer->verdict == bus::Answer::Verdict::kOvertaken || answer->verdict == bus::Answer::Verdict::kOutOfOrder;
      if (!disturbed || renamed) return *answer;
      renamed = true;
      sender_ = bus::newRunId();
      sent_ = 0;
      command = {run, sender_, ++sent_, parameter, value};
      send_at = 0;
    }
    if (monotonicNs() >= end || terminal::Interruption::came()) return std::nullopt;
    sleepUntilNs(monotonicNs() + kLookEvery);
  }
}

std::string textOfRun(std::uint64_t run) {
  std::array<char, 24> text;
  std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(run));
  return text.data();
}

std::uint64_t runFrom(const std::string& text) {
  std::uint64_t run = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), run, 16);
  return error == std::errc{} && end == text.data() + text.size() ? run : 0;
}

}  // namespace presa
