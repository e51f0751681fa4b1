#include "apps/presa/remote/measure.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <thread>

#include "apps/common/terminal/interruption.h"
#include "framework/bus/publisher.h"
#include "framework/bus/scene_hash.h"
#include "framework/core/schedule/clock.h"
#include "framework/scene/load.h"

namespace presa {
namespace {

constexpr std::int64_t kPeriodNs = 5'000'000;

/// A scene of small balls on a grid; `presa view --join` can show it, too.
std::string ballsXml(int objects) {
  std::string xml = R"(<scene version="1.0" name="bus_measurement"><world gravity="0 0 0"/>
    <materials><material name="wood" stiffness="1000" color="0.75 0.25 0.2"/></materials>)";
  for (int i = 0; i < objects; ++i) {
    std::array<char, 200> body;
    std::snprintf(
        body.data(), body.size(),
        R"(<body name="ball_%d" pos="%g %g 0.05"><physics mass="0.01"><sphere radius="0.01"/></physics></body>)", i,
        0.03 * (i % 12), 0.03 * (i / 12));
    xml += body.data();
  }
  return xml + "</scene>";
}

/// Publishes once per period of the clock.
class Sender {
 public:
  /// Opens the network; throws InputError.
  explicit Sender(const MeasureSettings& settings) : writer_(bus::openWriter(settings.bus)) {
    Diagnostics diagnostics;
    const World world =
        buildWorld(parseScene(ballsXml(settings.objects), "measurement", ".", {}, diagnostics), {}, diagnostics);
    if (diagnostics.hasErrors()) throw InputError(diagnostics);
    for (std::size_t b = 0; b < world.scene.bodies.size(); ++b) {
      bus::ObjectSample sample;
      sample.body = static_cast<std::int32_t>(b);
      sample.X_WB = world.scene.bodies[b].X_WB;
      objects_.push_back(sample);
      height_.push_back(sample.X_WB.p.z());
    }
    writer_->announce(
        {run_, bus::sceneHash(world), 1e-9 * kPeriodNs, true, world.scene.name, world.scene.resolved_xml});
  }
  void publishUntil(const std::atomic<bool>& end) {
    bus::Heartbeat heartbeat;
    heartbeat.objects = static_cast<std::int32_t>(objects_.size());
    const std::int64_t begin = monotonicNs();
    for (std::uint64_t n = 1; !heartbeat.last; ++n) {
      sleepUntilNs(begin + static_cast<std::int64_t>(n) * kPeriodNs);
      const double time = static_cast<double>(n) * 1e-9 * kPeriodNs;
      heartbeat.last = end;
      heartbeat.stamp = {run_, n, time, monotonicNs()};
      for (std::size_t b = 0; b < objects_.size(); ++b) {
        objects_[b].stamp = heartbeat.stamp;
        objects_[b].X_WB.p.z() = height_[b] + 0.02 * std::sin(3 * time + 0.2 * static_cast<double>(b));
      }
      heartbeat.refused += writer_->publish({objects_, {}, heartbeat});
    }
    writer_->finish();
  }

 private:
  std::unique_ptr<bus::Writer> writer_;
  std::uint64_t run_ = bus::newRunId();
  std::vector<bus::ObjectSample> objects_;
  std::vector<double> height_;
};

/// A viewer in a process of its own, and its result.
class Listener {
 public:
  explicit Listener(const MeasureSettings& settings) {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe for a viewer");
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
    std::vector<std::string> words{program,
                                   "bus",
                                   "listen",
                                   "--json",
                                   "--quiet",
                                   "--bus",
                                   settings.bus.network,
                                   "--domain",
                                   std::to_string(settings.bus.domain),
                                   "--for",
                                   std::to_string(settings.duration)};
    // the viewers' folder of keys lies beside that of the run
    if (!settings.bus.keys.empty())
      words.insert(words.end(),
                   {"--bus-keys", (std::filesystem::absolute(settings.bus.keys).parent_path() / "viewer").string()});
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const int failed = posix_spawn(&process_, program.c_str(), &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    answer_ = ends[0];
    if (failed != 0) {
      close(answer_);
      throw std::runtime_error("no viewer starts");
    }
  }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;
  ~Listener() { close(answer_); }

  ViewerStatistics result() {
    std::string text;
    std::array<char, 4096> part;
    bool signalled = false;
    for (ssize_t count = 1; count != 0;) {
      // a signal may reach only this process: end the viewer, too
      if (!signalled && terminal::Interruption::came()) signalled = ::kill(process_, SIGINT) == 0;
      pollfd waiting{answer_, POLLIN, 0};
      if (::poll(&waiting, 1, 20) <= 0) continue;
      count = read(answer_, part.data(), part.size());
      if (count > 0) text.append(part.data(), static_cast<std::size_t>(count));
    }
    int status = 0;
    waitpid(process_, &status, 0);
    const auto json = nlohmann::json::parse(text, nullptr, false);
    return json.is_discarded() ? ViewerStatistics{} : statisticsFrom(json);
  }

 private:
  pid_t process_ = -1;
  int answer_ = -1;
};

}  // namespace

std::vector<ViewerStatistics> measureBus(const MeasureSettings& settings) {
  std::atomic<bool> over{false};
  Sender sending(settings);
  std::thread sender([&] { sending.publishUntil(over); });
  std::thread progress([&] {
    const std::int64_t begin = monotonicNs();
    for (int line = 1; !over; ++line) {
      while (!over && monotonicNs() < begin + line * 2'000'000'000LL) sleepUntilNs(monotonicNs() + 50'000'000);
      if (!over && !settings.quiet)
        std::fprintf(stderr, "%d of %.0f s, %d objects to %d viewers\n", 2 * line, settings.duration, settings.objects,
                     settings.viewers);
    }
  });
  std::vector<ViewerStatistics> statistics;
  {
    std::vector<std::unique_ptr<Listener>> listeners;
    for (int v = 0; v < settings.viewers; ++v) listeners.push_back(std::make_unique<Listener>(settings));
    for (const auto& listener : listeners) statistics.push_back(listener->result());
  }
  over = true;
  progress.join();
  sender.join();
  return statistics;
}

}  // namespace presa
