// ./dev soak: fingers wander, press and slide over twenty real meshes for the given time. Every simulated minute is a
// separate run with its own mesh and seed, checked tick by tick by the oracles of tests/modules/haptics_proxy/surface.
#include <unistd.h>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <mutex>
#include <string>
#include <thread>

#include "tests/modules/haptics_proxy/surface/support/mesh_files.h"
#include "tests/modules/haptics_proxy/surface/support/wander_run.h"

namespace presa::test {
namespace {

std::atomic<bool> stopped = false;

struct Options {
  int minutes = 1000, jobs = 1;
  std::uint64_t seed = 1;  ///< seed of the first minute
  std::string mesh;        ///< one mesh; empty: all in turn
};

/// A mesh with its oracle.
struct Ground {
  std::shared_ptr<const TriMesh> mesh;
  std::unique_ptr<const MeshOracle> oracle;
  bool closed = false;
};

/// Loads each mesh once. Thread: any.
const Ground& groundOf(const std::string& name) {
  static std::mutex mutex;
  static std::map<std::string, Ground> grounds;
  const std::lock_guard lock(mutex);
  Ground& ground = grounds[name];
  if (!ground.mesh) {
    ground.mesh = std::make_shared<const TriMesh>(realMesh(name));
    ground.oracle = std::make_unique<const MeshOracle>(*ground.mesh);
    ground.closed = checkMesh(*ground.mesh).open_edges == 0;
  }
  return ground;
}

/// The finger's parameters follow from the seed, so that mesh and seed reproduce a run.
Touch touchOf(std::uint64_t seed) {
  constexpr double kRadii[] = {0.002, 0.008, 0.0005}, kFriction[] = {0.5, 0.5, 0, 0.9};
  return {.radius = kRadii[seed % 3], .friction = kFriction[seed / 3 % 4]};
}
bool isStiff(std::uint64_t seed) { return seed / 12 % 3 == 2; }

std::string duration(double seconds) {
  char text[32];
  const int minutes = static_cast<int>(seconds / 60);
  if (minutes >= 60) {
    std::snprintf(text, sizeof text, "%d h %02d min", minutes / 60, minutes % 60);
  } else {
    std::snprintf(text, sizeof text, "%d min %02d s", minutes, static_cast<int>(seconds) % 60);
  }
  return text;
}

class Soak {
 public:
  explicit Soak(const Options& options) : options_(options), begin_(std::chrono::steady_clock::now()) {}

  int run() {
    std::printf("%d simulated minutes, seeds from %llu on, %s; Ctrl-C ends it with a summary\n", options_.minutes,
                static_cast<unsigned long long>(options_.seed),
                options_.mesh.empty() ? "twenty meshes in turn" : options_.mesh.c_str());
    for (const std::string& name : realMeshes()) {
      if (options_.mesh.empty() || name == options_.mesh) static_cast<void>(packagedMesh(name));  // throws if missing
    }
    std::vector<std::thread> threads;
    threads.reserve(static_cast<std::size_t>(options_.jobs));
    for (int i = 0; i < options_.jobs; ++i) threads.emplace_back([this] { work(); });
    for (std::thread& thread : threads) thread.join();
    return summary();
  }

 private:
  void work() {
    for (;;) {
      const int minute = next_++;
      if (minute >= options_.minutes || stopped) return;
      const std::vector<std::string>& all = realMeshes();
      const std::string& name =
          options_.mesh.empty() ? all[static_cast<std::size_t>(minute) % all.size()] : options_.mesh;
      oneMinute(name, options_.seed + static_cast<std::uint64_t>(minute));
    }
  }

  void oneMinute(const std::string& name, std::uint64_t seed) {
    const Ground& ground = groundOf(name);
    WanderRun run(ground.mesh, *ground.oracle, touchOf(seed), seed, isStiff(seed), ground.closed);
    constexpr int kSeconds = 60;
    for (int second = 0; second < kSeconds && !stopped; ++second) run.run(1000);
    const std::lock_guard lock(mutex_);
    report(name, seed, run.faults(), ground.closed);
  }

  void report(const std::string& name, std::uint64_t seed, const WanderFaults& faults, bool closed) {
    const bool on_terminal = isatty(STDOUT_FILENO) != 0;
    if (on_terminal) std::printf("\r\033[K");
    if (faults.any()) {
      const Touch touch = touchOf(seed);
      std::printf("BAD  --mesh %s --seed %llu (radius %g mm, friction %g, %s): ", name.c_str(),
                  static_cast<unsigned long long>(seed), touch.radius * 1e3, touch.friction,
                  isStiff(seed) ? "stiff" : "yielding");
      if (faults.inside > 0) {
        const MeshOracle& oracle = *groundOf(name).oracle;
        std::printf(
            "inside %lld ticks from %.3f s on, in one tick from %.2f mm outside (winding number %.3f) to %.2f mm "
            "inside (%.3f); ",
            static_cast<long long>(faults.inside), faults.first_inside, oracle.nearest(faults.before).distance * 1e3,
            oracle.solidAngles(faults.before), oracle.nearest(faults.after).distance * 1e3,
            oracle.solidAngles(faults.after));
      }
      if (faults.overlapping > 0)
        std::printf("overlapping %lld ticks by up to %.0f um; ", static_cast<long long>(faults.overlapping),
                    faults.deepest * 1e6);
      std::printf("pop_through %u, force above k depth %lld, not finite %lld, coverage_lost %u\n", faults.popped,
                  static_cast<long long>(faults.too_strong), static_cast<long long>(faults.not_finite), faults.lost);
    }
    Sum& sum = sums_[name];
    sum.closed = closed;
    sum.ticks += faults.ticks;
    sum.touching += faults.touching;
    sum.inside += faults.inside > 0;
    sum.overlapping += faults.overlapping > 0;
    sum.popped += faults.popped;
    sum.too_strong += faults.too_strong + faults.not_finite;
    sum.lost += faults.lost;
    ++done_;
    bad_ += faults.any();
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    if (on_terminal) {
      std::printf("%d of %d min, %d bad, %s left", done_, options_.minutes, bad_,
                  duration(seconds / done_ * (options_.minutes - done_)).c_str());
    } else if (done_ % 20 == 0) {
      std::printf("%d of %d min, %d bad, %s left\n", done_, options_.minutes, bad_,
                  duration(seconds / done_ * (options_.minutes - done_)).c_str());
    }
    std::fflush(stdout);
  }

  int summary() {
    std::printf("\n%-12s %8s %9s %8s %8s %8s %8s %8s\n", "mesh", "min", "touching", "inside", "overlap", "popped",
                "too hard", "lost");
    double ticks = 0;
    for (const auto& [name, sum] : sums_) {
      ticks += static_cast<double>(sum.ticks);
      std::printf("%-12s %8.1f %7.0f %% %8s %8d %8llu %8lld %8llu\n", name.c_str(),
                  static_cast<double>(sum.ticks) / 60e3,
                  100.0 * static_cast<double>(sum.touching) / static_cast<double>(std::max<std::int64_t>(1, sum.ticks)),
                  sum.closed ? std::to_string(sum.inside).c_str() : "open", sum.overlapping,
                  static_cast<unsigned long long>(sum.popped), static_cast<long long>(sum.too_strong),
                  static_cast<unsigned long long>(sum.lost));
    }
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    std::printf("%s%.1f simulated minutes in %s: %d of %d runs bad\n", stopped ? "stopped after " : "", ticks / 60e3,
                duration(seconds).c_str(), bad_, done_);
    return bad_ > 0 ? 1 : stopped ? 130 : 0;
  }

  struct Sum {
    bool closed = false;
    std::int64_t ticks = 0, touching = 0, too_strong = 0;
    int inside = 0, overlapping = 0;  ///< number of runs
    std::uint64_t popped = 0, lost = 0;
  };
  const Options options_;
  const std::chrono::steady_clock::time_point begin_;
  std::atomic<int> next_ = 0;
  std::mutex mutex_;
  std::map<std::string, Sum> sums_;
  int done_ = 0, bad_ = 0;
};

[[noreturn]] void usage(int code) {
  std::printf(
      "usage: ./dev soak [MINUTES] [--mesh NAME] [--seed N] [--jobs N] [--list]\n"
      "  MINUTES   simulated, 1000 when nothing is said\n"
      "  --mesh    one mesh instead of twenty in turn\n"
      "  --seed    of the first minute; each further minute has the next (default 1)\n"
      "  --list    the meshes, and which of them are closed\n"
      "To see a run again: ./dev soak 1 --mesh NAME --seed N\n");
  std::exit(code);
}

int list() {
  for (const std::string& name : realMeshes()) {
    const Ground& ground = groundOf(name);
    std::printf("%-12s %7zu triangles, %s\n", name.c_str(), ground.mesh->triangles.size(),
                ground.closed ? "closed" : "open: where a finger is inside is not judged");
  }
  return 0;
}

int number(const char* text) {
  char* end = nullptr;
  const long value = std::strtol(text, &end, 10);
  if (*text == 0 || *end != 0 || value < 1 || value > 1'000'000'000) usage(2);
  return static_cast<int>(value);
}

int soak(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const auto next = [&] { return i + 1 < argc ? argv[++i] : (usage(2), nullptr); };
    if (word == "--mesh") {
      options.mesh = next();
    } else if (word == "--seed") {
      options.seed = static_cast<std::uint64_t>(number(next()));
    } else if (word == "--jobs") {
      options.jobs = number(next());
    } else if (word == "--list") {
      return list();
    } else if (word == "--help" || word == "-h") {
      usage(0);
    } else {
      options.minutes = number(argv[i]);
    }
  }
  const std::vector<std::string>& all = realMeshes();
  if (!options.mesh.empty() && std::find(all.begin(), all.end(), options.mesh) == all.end()) {
    std::fprintf(stderr, "error: no mesh '%s'; ./dev soak --list names them\n", options.mesh.c_str());
    return 2;
  }
  std::signal(SIGINT, [](int) { stopped = true; });
  std::signal(SIGTERM, [](int) { stopped = true; });
  return Soak(options).run();
}

}  // namespace
}  // namespace presa::test

int main(int argc, char** argv) {
  try {
    return presa::test::soak(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 2;
  }
}
