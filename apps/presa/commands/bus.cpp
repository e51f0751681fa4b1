#include <cstdio>
#include <optional>
#include <random>

#include "apps/common/atomic_file.h"
#include "apps/common/options/bus_options.h"
#include "apps/common/terminal/interruption.h"
#include "apps/presa/commands/commands.h"
#include "apps/presa/remote/measure.h"
#include "apps/presa/remote/viewer.h"
#include "framework/core/state/limits.h"

namespace presa {
namespace {

void print(const ViewerStatistics& statistics, const char* who) {
  if (!statistics.joined) {
    std::printf("%s: joined no run\n", who);
    return;
  }
  std::printf("%s: %.1f s, lost %llu of %llu samples, %llu twice, %llu late; %llu dropped here, %llu never sent\n", who,
              statistics.seconds, static_cast<unsigned long long>(statistics.lost),
              static_cast<unsigned long long>(statistics.received + statistics.lost),
              static_cast<unsigned long long>(statistics.doubled), static_cast<unsigned long long>(statistics.late),
              static_cast<unsigned long long>(statistics.overrun), static_cast<unsigned long long>(statistics.refused));
  std::printf("    latency p50 %.3f ms, p99 %.3f ms, longest %.3f ms\n", 1e3 * statistics.latency_p50,
              1e3 * statistics.latency_p99, 1e3 * statistics.latency_max);
}

bool clean(const ViewerStatistics& statistics) {
  return statistics.joined && statistics.received > 0 && statistics.lost == 0 && statistics.overrun == 0 &&
         statistics.refused == 0;
}

void addListen(Command app, int& status) {
  struct Arguments {
    std::vector<std::string> meshes;
    double wait = 10, duration = 10;
    bool json = false, quiet = false;
  };
  auto a = std::make_shared<Arguments>();
  auto bus = std::make_shared<std::optional<BusSettings>>();
  Command command = app.command("listen", "Join a run without a picture, and measure loss and latency");
  addBusOptions(command, *bus, "the network that the run is on");
  command.option("--wait", a->wait, "seconds to wait for a run").nonNegative().showDefault();
  addMeshesOption(command, a->meshes);
  command.option("--for", a->duration, "seconds to listen").positive().showDefault();
  command.flag("--json", a->json, "the figures as JSON");
  command.flag("--quiet", a->quiet, "nothing on stderr");
  command.footer(
      "Latencies are valid on the machine of the run only. Exit status: 0 nothing lost, 1 something, 3 no run.");
  command.action([=, &status] {
    const terminal::Interruption interruption;
    const ViewerStatistics statistics = listen(bus->value_or(BusSettings{}), a->meshes, a->wait, a->duration, a->quiet);
    if (a->json)
      std::printf("%s\n", toJson(statistics).dump(2).c_str());
    else
      print(statistics, "listened");
    status = !statistics.joined ? kExitNoRun : clean(statistics) ? kExitOk : kExitFault;
  });
}

void addMeasure(Command app, int& status) {
  auto settings = std::make_shared<MeasureSettings>();
  auto bus = std::make_shared<std::optional<BusSettings>>();
  auto out = std::make_shared<std::string>();
  Command command = app.command("measure", "Objects at 200 Hz to viewers in processes of their own: loss and latency");
  command.option("--objects", settings->objects, "bodies that move").withinCount(1, kMaxBodies).showDefault();
  command.option("--viewers", settings->viewers, "processes that listen").withinCount(1, 16).showDefault();
  command.option("--for", settings->duration, "seconds").within(0.5, 1e5).showDefault();
  addBusOptions(command, *bus, "network to measure (default: loopback, on a domain of its own)");
  command.option("--json", *out, "file for the figures");
  command.flag("--quiet", settings->quiet, "no progress");
  command.footer(
      "Exit status: 0 nothing lost, 1 something lost.\nExample:  presa bus measure --objects 120 --viewers 2 --for 60");
  command.action([=, &status] {
    if (*bus)
      settings->bus = **bus;
    else
      settings->bus.domain = 1 + static_cast<int>(std::random_device{}() % kMaxBusDomain);  // away from other runs
    const terminal::Interruption interruption;
    const std::vector<ViewerStatistics> statistics = measureBus(*settings);
    auto json = nlohmann::ordered_json::array();
    status = kExitOk;
    for (std::size_t v = 0; v < statistics.size(); ++v) {
      print(statistics[v], ("viewer " + std::to_string(v + 1)).c_str());
      json.push_back(toJson(statistics[v]));
      if (!clean(statistics[v])) status = kExitFault;
    }
    if (!out->empty()) writeFileAtomically(*out, json.dump(2) + "\n");
    if (terminal::Interruption::came()) status = kExitInterrupted;
  });
}

}  // namespace

void addBus(Command app, int& status) {
  Command command = app.command("bus", "Runs on the network: which there are, what is lost, setting their parameters");
  command.needCommand();
  addBusList(command, status);
  addBusSet(command, status);
  addBusKeys(command, status);
  addListen(command, status);
  addMeasure(command, status);
}

}  // namespace presa
