// The haptic tick beside a window: one run in real time, in which blocks with a window that draws, with one that cannot
// draw, and with a processor that is busy with nothing take turns in random order. Neighbouring blocks are compared, so
// that a machine whose speed drifts favours none. The window cannot draw while its display server is stopped. On two
// processors that do nothing else: xvfb-run -a -s '-screen 0 1280x720x24' ./dev bench Beside
#include <benchmark/benchmark.h>
#include <csignal>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "framework/core/schedule/clock.h"
#include "framework/session/run.h"
#include "tests/bench/shipped_scene.h"

namespace presa {
namespace {

enum Kind { kIdle, kLoop, kWindow, kKinds };

constexpr std::int64_t kBlock = 250'000'000, kSettle = 30'000'000;  // [ns]; a block's first ticks count as neither
constexpr std::size_t kRoom = 1000;                                 // ticks of a block, at most

/// The ticks of the block that runs now. Written by the haptic thread; read by main between blocks.
struct Block {
  std::atomic<bool> counts{false};
  std::atomic<std::size_t> count{0};
  std::array<std::int64_t, kRoom> ns{};
} block;
thread_local bool is_haptic = false;

// The executor reads its clock at both ends of a tick.
std::int64_t clockOfTicks() noexcept {
  thread_local std::int64_t begin = 0;
  const std::int64_t now = monotonicNs();
  if (!is_haptic) return now;
  if (begin == 0) {
    begin = now;
    return now;
  }
  const std::size_t i = block.count.load(std::memory_order_relaxed);
  if (block.counts.load(std::memory_order_acquire) && i < kRoom) {
    block.ns[i] = now - begin;
    block.count.store(i + 1, std::memory_order_release);
  }
  begin = 0;
  return now;
}

/// Marks the haptic thread.
struct Marker final : Module {
  Marker() : Module("marker", RateGroup::kHaptic) {}
  void start() override { is_haptic = true; }
  void step(const Tick&) noexcept override {}
};

/// Keeps a processor busy that shares no memory with the ticks.
class Loop {
 public:
  ~Loop() {
    thread_.request_stop();
    spin(true);  // wakes it
  }
  void spin(bool on) {
    spins_ = on;
    spins_.notify_one();
  }

 private:
  void run(const std::stop_token& stop) {
    std::uint64_t x = 1;
    while (!stop.stop_requested()) {
      spins_.wait(false);
      for (int i = 0; i < 1000; ++i) benchmark::DoNotOptimize(x = 6364136223846793005U * x + 1);
    }
  }
  std::atomic<bool> spins_{false};
  std::jthread thread_{[this](const std::stop_token& stop) { run(stop); }};
};

/// Process of the display server, from its lock file; 0: unknown.
pid_t serverOf(const std::string& display) {
  std::ifstream lock("/tmp/.X" + display.substr(display.find(':') + 1) + "-lock");
  pid_t process = 0;
  lock >> process;
  return process;
}

double processorMs() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

using Turn = std::array<double, kKinds>;

/// Switches from block to block and keeps their medians.
class Turns {
 public:
  /// `until`: when the display server goes on for good [ns], or the run could not close its window.
  Turns(pid_t server, Loop& loop, std::int64_t until) : server_(server), loop_(loop), until_(until) {}
  Turns(const Turns&) = delete;
  ~Turns() { letDraw(true); }

  void poll() {
    const std::int64_t now = monotonicNs();
    if (now > until_) return letDraw(true);
    if (began_ == 0) return begin(order_[at_], now);
    if (!block.counts && now - began_ >= kSettle) {
      block.count = 0;
      block.counts = true;
    }
    if (now - began_ < kBlock) return;
    end(now);
    if (++at_ == kKinds) {
      at_ = 0;
      std::ranges::shuffle(order_, chance_);
    }
    begin(order_[at_], now);
  }
  /// Medians by kind [ns]; 0: no block of that kind ended in the turn.
  const std::vector<Turn>& all() const { return turns_; }
  double processorShare(Kind kind) const { return busy_ms_[kind] * 1e6 / std::max(1.0, wall_ns_[kind]); }

 private:
  void begin(Kind kind, std::int64_t now) {
    if (at_ == 0) turns_.push_back({});
    began_ = now;
    begin_ms_ = processorMs();
    letDraw(kind == kWindow);
    loop_.spin(kind == kLoop);
  }
  void letDraw(bool draws) { kill(server_, draws ? SIGCONT : SIGSTOP); }
  void end(std::int64_t now) {
    block.counts = false;
    const Kind kind = order_[at_];
    busy_ms_[kind] += processorMs() - begin_ms_;
    wall_ns_[kind] += static_cast<double>(now - began_);
    const auto count = static_cast<std::ptrdiff_t>(block.count);
    if (count == 0) return;
    const auto middle = block.ns.begin() + count / 2;
    std::nth_element(block.ns.begin(), middle, block.ns.begin() + count);
    turns_.back()[kind] = static_cast<double>(*middle);
  }

  const pid_t server_;
  Loop& loop_;
  const std::int64_t until_;
  std::mt19937 chance_{1};
  std::array<Kind, kKinds> order_{kWindow, kIdle, kLoop};
  std::size_t at_ = 0;
  std::int64_t began_ = 0;
  double begin_ms_ = 0;
  std::array<double, kKinds> busy_ms_{}, wall_ns_{};
  std::vector<Turn> turns_;
};

/// Ratio of two kinds over all turns: mean of the logarithms, with twice its standard error.
void compare(benchmark::State& state, const std::string& name, const std::vector<Turn>& turns, Kind a, Kind b) {
  double n = 0, sum = 0, squares = 0;
  for (const Turn& turn : turns) {
    if (turn[a] == 0 || turn[b] == 0) continue;
    const double log = std::log(turn[a] / turn[b]);
    ++n;
    sum += log;
    squares += log * log;
  }
  const double mean = sum / n, error = std::sqrt(std::max(0.0, squares / n - mean * mean) / (n - 1));
  state.counters[name] = std::exp(mean);
  state.counters[name + "_low"] = std::exp(mean - 2 * error);
  state.counters[name + "_high"] = std::exp(mean + 2 * error);
}

double medianUs(std::vector<Turn> turns, Kind kind) {
  std::ranges::sort(turns, {}, [&](const Turn& turn) { return turn[kind]; });
  return turns.empty() ? 0 : turns[turns.size() / 2][kind] * 1e-3;
}

void BM_HapticTickBeside(benchmark::State& state, const char* scene) {
  const char* const display = std::getenv("DISPLAY");
  const pid_t server = display == nullptr ? 0 : serverOf(display);
  if (server == 0) return state.SkipWithError("needs a display of its own: xvfb-run");
  RunOptions options;
  options.realtime = true;
  options.view = RunOptions::View::kWindow;
  options.duration = 60;
  RunControl control;
  Session::Options more;
  more.more.push_back(std::make_unique<Marker>());
  Run run(bench::loadShipped(scene, {}, options), control, std::move(more));
  run.executor().timeBy(clockOfTicks);
  Loop loop;  // made after the run, which keeps other threads off the haptic thread's processor
  Turns turns(server, loop, monotonicNs() + static_cast<std::int64_t>((options.duration - 2) * 1e9));
  run.onPoll([&] { turns.poll(); });
  for (auto _ : state) run.execute();
  compare(state, "window_to_idle", turns.all(), kWindow, kIdle);
  compare(state, "window_to_loop", turns.all(), kWindow, kLoop);
  compare(state, "loop_to_idle", turns.all(), kLoop, kIdle);
  state.counters["idle_us"] = medianUs(turns.all(), kIdle);
  state.counters["window_us"] = medianUs(turns.all(), kWindow);
  state.counters["turns"] = static_cast<double>(turns.all().size());
  state.counters["drawing_processors"] = turns.processorShare(kWindow);
  state.counters["idle_processors"] = turns.processorShare(kIdle);
}
BENCHMARK_CAPTURE(BM_HapticTickBeside, cube, "cube.xml")->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace presa
