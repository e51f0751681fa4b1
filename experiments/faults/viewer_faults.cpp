#include <array>
#include <optional>

#include "experiments/faults/fault.h"
#include "experiments/faults/hold.h"
#include "framework/bus/local_bus.h"
#include "framework/bus/publisher.h"
#include "framework/bus/remote_picture.h"
#include "framework/bus/troubled_reader.h"

namespace presa::faults {
namespace {

constexpr int kNetworkRuns = 100;  // each opens a network

/// Forces and energies of a complete hold, tick by tick.
struct Trace {
  std::vector<std::array<Vec3, 2>> force;
  std::vector<std::array<double, 2>> energy;
  double step = 0;
  bool operator==(const Trace& other) const { return force == other.force && energy == other.energy; }
};

Trace traceOf(const Hold& hold, Outcome& outcome, const std::function<void(double)>& meanwhile = {}) {
  Trace trace;
  runHold(hold, [&](double time, const Traffic& traffic) {
    requireBounded(traffic, kHoldLimit, outcome);
    trace.force.push_back(traffic.force);
    trace.energy.push_back(traffic.energy);
    trace.step = traffic.step;
    if (meanwhile) meanwhile(time);
  });
  return trace;
}

/// Viewers that join and leave without notice at random moments. Some never take what arrives; all are behind a network
/// that loses, duplicates and delays messages.
class Viewers {
 public:
  Viewers(RandomStream& random, std::function<std::unique_ptr<bus::Reader>()> join)
      : random_(random), join_(std::move(join)) {}

  void at(double) {
    for (std::optional<Viewer>& viewer : viewers_) {
      const double chance = random_.uniform();
      if (!viewer) {
        if (chance < 0.002) come(viewer);
      } else if (chance < 0.001) {
        viewer.reset();
      } else if (viewer->takes && chance > 0.99) {
        viewer->reader->take(*viewer->picture);
      }
    }
  }
  void come(const World& world) {
    world_ = &world;
    for (std::optional<Viewer>& viewer : viewers_) come(viewer);
  }
  int came() const { return came_; }

 private:
  struct Viewer {
    std::unique_ptr<bus::Reader> reader;
    std::unique_ptr<bus::RemotePicture> picture;
    bool takes;
  };
  void come(std::optional<Viewer>& viewer) {
    if (world_ == nullptr) return;
    const bus::TroubledReader::Trouble trouble{random_.uniform(0, 0.5), random_.uniform(0, 0.5),
                                               random_.uniform(0, 0.5)};
    viewer.emplace(Viewer{std::make_unique<bus::TroubledReader>(join_(), trouble, random_.bits()),
                          std::make_unique<bus::RemotePicture>(*world_), random_.below(3) > 0});
    ++came_;
  }

  RandomStream& random_;
  std::function<std::unique_ptr<bus::Reader>()> join_;
  const World* world_ = nullptr;
  std::array<std::optional<Viewer>, 3> viewers_;
  int came_ = 0;
};

/// The same hold with and without a bus must give bit-identical forces. `network`: real packets over loopback.
Outcome watched(RandomStream& random, bool network) {
  Outcome outcome;
  Hold hold;
  hold.end = random.uniform(1.2, 1.6);
  const Trace alone = traceOf(hold, outcome);
  // a small buffer, so that a viewer that does not read is flooded at once
  bus::LocalBus local(64);
  const BusSettings settings{.network = "loopback", .domain = 1 + static_cast<int>(random.below(kMaxBusDomain))};
  Viewers viewers(random, [&] { return network ? bus::openReader(settings) : local.reader(); });
  hold.more = [&](const std::shared_ptr<const World>& world) {
    viewers.come(*world);
    return std::make_unique<bus::Publisher>(world, RunOptions{},
                                            [&] { return network ? bus::openWriter(settings) : local.writer(); });
  };
  const Trace with = traceOf(hold, outcome, [&](double time) { viewers.at(time); });
  outcome.step = with.step;
  if (alone.force.empty() || viewers.came() < 3) outcome.broken.emplace_back("fewer than three viewers joined");
  if (!(alone == with)) outcome.broken.emplace_back("the forces are not bit-identical");
  return outcome;
}

}  // namespace

std::vector<Fault> viewerFaults() {
  const std::string required = "every force bit-identical to a run without a bus";
  return {
      {20,
       "viewers slow, flooded, gone and back",
       required,
       {},
       [](RandomStream& random) { return watched(random, false); }},
      {20,
       "viewers slow, flooded, gone and back (network)",
       required,
       {},
       [](RandomStream& random) { return watched(random, true); },
       kNetworkRuns},
  };
}

}  // namespace presa::faults
