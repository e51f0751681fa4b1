#include "apps/studies/cost/measure.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string_view>

#include "apps/common/shell.h"
#include "framework/core/schedule/clock.h"

namespace presa::cost {
namespace {

/// Min time that reading the clock adds to a measured tick [s].
double clockCost() {
  std::int64_t min = std::numeric_limits<std::int64_t>::max();
  for (int i = 0; i < 2000; ++i) {
    const std::int64_t begin = threadCpuNs();
    min = std::min(min, threadCpuNs() - begin);
  }
  return static_cast<double>(min) * 1e-9;
}

double residentBytes() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    double kilobytes = 0;
    if (word == "VmRSS:" && status >> kilobytes) return kilobytes * 1024;
  }
  return 0;
}

/// Number of instructions of one whole run.
double callgrind(const StudySpec& spec, double duration) {
  const std::string program = (std::filesystem::read_symlink("/proc/self/exe").parent_path() / "presa").string();
  std::string command = "valgrind --tool=callgrind --callgrind-out-file=/dev/null " + shell::quoted(program) + " run " +
                        shell::quoted(spec.scene) + " --lockstep --view none --quiet --seed " +
                        std::to_string(spec.seed) + " --for " + std::to_string(duration);
  if (!spec.rig.empty()) command += " --rig " + shell::quoted(spec.rig);
  for (const std::string& set : spec.sets) command += " --set " + shell::quoted(set);
  const shell::Outcome outcome = shell::run(command);
  constexpr std::string_view kMark = "Collected : ";
  const std::string text = outcome.out + outcome.err;
  const std::size_t at = text.find(kMark);
  const double collected = at == std::string::npos ? 0 : std::atof(text.c_str() + at + kMark.size());
  if (!(collected > 0)) throw std::runtime_error("valgrind counted nothing");
  return collected;
}

}  // namespace

Timing timeRun(const StudySpec& spec) {
  const double memory = residentBytes();
  const std::int64_t begin = threadCpuNs();
  StudyRun run(spec);
  Timing timing;
  timing.load = static_cast<double>(threadCpuNs() - begin) * 1e-9;
  timing.engines = run.engines();
  run.timeProcessor();
  run.run();
  timing.memory = residentBytes() - memory;
  const double off = clockCost();
  const RateTable rates(run.world().scene.rates);
  for (int g = 0; g < kRateGroupCount; ++g) {
    const auto group = static_cast<RateGroup>(g);
    const GroupTiming& measured = run.timing(group);
    if (measured.ticks == 0) continue;
    const auto seconds = [off](double ns) { return std::max(0.0, ns * 1e-9 - off); };
    timing.groups.push_back({toString(group), rates.period(group), measured.ticks, seconds(measured.execution.mean()),
                             seconds(static_cast<double>(measured.execution.percentile(0.5))),
                             seconds(static_cast<double>(measured.execution.percentile(0.999)))});
    timing.per_second += timing.groups.back().mean * static_cast<double>(measured.ticks) / run.duration();
  }
  return timing;
}

double countInstructions(const StudySpec& spec) {
  constexpr double kStart = 0.01;  // simulated [s]: all start-up and almost nothing else
  const double duration = StudyRun(spec).duration();
  return (callgrind(spec, duration) - callgrind(spec, kStart)) / (duration - kStart);
}

}  // namespace presa::cost
