#include "apps/presa/remote/listen.h"

#include <cstdio>

#include "apps/common/terminal/interruption.h"
#include "apps/presa/remote/join.h"
#include "framework/bus/mesh_store.h"
#include "framework/bus/remote_picture.h"
#include "framework/core/diagnostics/printable.h"
#include "framework/core/schedule/clock.h"
#include "framework/scene/load.h"

namespace presa {

ViewerStatistics listen(const BusSettings& settings, const std::vector<std::string>& meshes, double wait,
                        double duration, bool quiet) {
  const auto reader = bus::openReader(settings);
  const auto run = awaitRun(*reader, wait);
  if (!run) return {};
  Diagnostics diagnostics;
  Scene scene = parseScene(run->scene_xml, "scene '" + printable(run->scene_name) + "'", ".", {}, diagnostics);
  bus::takeFromMeshStore(scene, *run, meshes, diagnostics);
  World world;
  if (!diagnostics.hasErrors()) world = buildWorld(std::move(scene), {}, diagnostics);
  if (diagnostics.hasErrors()) throw InputError(diagnostics);
  if (!quiet) std::fprintf(stderr, "joined the run of scene '%s'\n", printable(run->scene_name).c_str());
  bus::RemotePicture picture(world);
  picture.onRun(*run, monotonicNs());
  const std::int64_t begin = monotonicNs();
  double seconds = 0;
  // takes samples once per frame, as a viewer does
  while (seconds < duration && picture.state() != bus::RemotePicture::State::kEnded &&
         !terminal::Interruption::came()) {
    sleepUntilNs(monotonicNs() + 16'000'000);
    reader->take(picture);
    picture.advance(monotonicNs());
    seconds = static_cast<double>(monotonicNs() - begin) * 1e-9;
  }
  const auto health = picture.health();
  const DurationHistogram& latency = picture.latency();
  const auto at = [&](double share) { return static_cast<double>(latency.percentile(share)) * 1e-9; };
  return {health.received,
          health.lost,
          health.doubled,
          health.late,
          health.refused,
          reader->overrun(),
          seconds,
          at(0.5),
          at(0.99),
          static_cast<double>(latency.max()) * 1e-9,
          true,
          picture.state() == bus::RemotePicture::State::kEnded};
}

nlohmann::ordered_json toJson(const ViewerStatistics& statistics) {
  return {{"joined", statistics.joined},
          {"ended", statistics.ended},
          {"seconds", statistics.seconds},
          {"received", statistics.received},
          {"lost", statistics.lost},
          {"doubled", statistics.doubled},
          {"late", statistics.late},
          {"never_sent", statistics.refused},
          {"overrun", statistics.overrun},
          {"latency_p50_s", statistics.latency_p50},
          {"latency_p99_s", statistics.latency_p99},
          {"latency_max_s", statistics.latency_max}};
}

ViewerStatistics statisticsFrom(const nlohmann::json& json) {
  ViewerStatistics statistics;
  statistics.joined = json.at("joined");
  statistics.ended = json.at("ended");
  statistics.seconds = json.at("seconds");
  statistics.received = json.at("received");
  statistics.lost = json.at("lost");
  statistics.doubled = json.at("doubled");
  statistics.late = json.at("late");
  statistics.refused = json.at("never_sent");
  statistics.overrun = json.at("overrun");
  statistics.latency_p50 = json.at("latency_p50_s");
  statistics.latency_p99 = json.at("latency_p99_s");
  statistics.latency_max = json.at("latency_max_s");
  return statistics;
}

}  // namespace presa
