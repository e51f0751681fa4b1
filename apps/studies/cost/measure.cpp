#include "apps/studies/cost/measure.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>

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

std::string quotedForShell(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

/// Number of instructions of one whole run.
double callgrind(const StudySpec& spec, double duration) {
  const std::string program = (std::filesystem::read_symlink("/proc/self/exe").parent_path() / "presa").string();
  std::string command = "valgrind --tool=callgrind --callgrind-out-file=/dev/null " + quotedForShell(program) +
                        " run " + quotedForShell(spec.scene) + " --lockstep --view none --quiet --seed " +
                        std::to_string(spec.seed) + " --for " + std::to_string(duration);
  if (!spec.rig.empty()) command += " --rig " + quotedForShell(spec.rig);
  for (const std::string& set : spec.sets) command += " --set " + quotedForShell(set);
  std::FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("valgrind could not be started");
  double collected = 0;
  std::array<char, 512> line;
  while (std::fgets(line.data(), line.size(), pipe) != nullptr) {
    const std::string text = line.data();
    if (const std::size_t at = text.find("Collected : "); at != std::string::npos)
      collected = std::atof(text.c_str() + at + 12);
  }
  ::pclose(pipe);
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
