#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>

#include "experiments/stability/bodies.h"
#include "experiments/stability/cases.h"
#include "experiments/stability/methods.h"
#include "experiments/stability/random_hand.h"
#include "experiments/study/compliant_finger.h"
#include "framework/device/output_stage.h"

namespace presa::stability::endurance {
namespace {

constexpr double kDuration = 60;                                    // [s]
constexpr double kEdge = 0.05, kRadius = 0.008, kStiffness = 2000;  // as in the scene [m, m, N/m]
constexpr double kHalfBin = 0.2;                                    // inside of the bin [m]
constexpr double kWarm = 10;                                        // [s] until every buffer has reached its size

/// Resident memory of this process [bytes].
double residentMemory() {
  std::ifstream file("/proc/self/statm");
  double total = 0, resident = 0;
  file >> total >> resident;
  return resident * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

/// Distance of a point from the surface of a box in its own frame; negative inside.
double distanceFromBox(const Vec3& p, const Vec3& half) {
  const Vec3 q = p.cwiseAbs() - half;
  return q.cwiseMax(0).norm() + std::min(0.0, q.maxCoeff());
}

double lowestCorner(const Pose& X_WB) {
  double low = HUGE_VAL;
  for (int i = 0; i < 8; ++i) {
    const Vec3 corner = kEdge / 2 * Vec3((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1);
    low = std::min(low, (X_WB * corner).z());
  }
  return low;
}

/// Distance of a touching fingertip centre from its ideal place, one radius off the nearest box [m].
double offSurface(const HapticSample& sample, const World& world, const Vec3& p_WP) {
  double off = HUGE_VAL;
  for (std::size_t b = 0; b < world.scene.bodies.size(); ++b) {
    const Vec3 p = sample.objects->poseAt(static_cast<std::int32_t>(b), sample.tick.time).inverseTimes(p_WP);
    const Vec3 half = std::get<Box>(world.scene.bodies[b].haptic->shape).size / 2;
    off = std::min(off, std::abs(distanceFromBox(p, half) - kRadius));
  }
  return off;
}

/// Measurements of one minute of play.
struct Watch {
  double faults = 0;        ///< ticks with a fault bit, or a force that is not finite or above the limit
  double passed = 0;        ///< surfaces passed and proxies left waiting
  double proxy_off = 0;     ///< max distance of a touching proxy from the surface [m]
  double quiet_speed = 0;   ///< max speed in the quiet moments [m/s]
  double quiet_height = 0;  ///< max distance of the lowest corner from the floor in the quiet moments [m]
  double memory_warm = 0, memory_end = 0;
  Curve energy{"energy of the cube", {}, {}};

  void see(const HapticSample& sample, const World& world, std::size_t cube, bool quiet);
};

void Watch::see(const HapticSample& sample, const World& world, std::size_t cube, bool quiet) {
  const Scene& scene = world.scene;
  bool bad = sample.objects->faults != 0 || (sample.command.status & (kOutputNotFinite | kOutputWatchdog)) != 0;
  for (std::size_t f = 0; f < sample.contact.fingers.size(); ++f) {
    const FingerContact& finger = sample.contact.fingers[f];
    bad = bad || !sample.command.f_H_W[f].allFinite() ||
          sample.command.f_H_W[f].norm() > scene.devices[f].limits.force * (1 + 1e-12);
    if (finger.mode == ContactMode::kNone) continue;
    proxy_off = std::max(proxy_off, offSurface(sample, world, finger.p_WP));
  }
  if (bad) ++faults;
  const BodyMotion& motion = sample.objects->bodies[cube];
  const double speed = motion.v_WB.norm() + motion.w_WB.norm() * kEdge * std::sqrt(3) / 2;
  const double height = lowestCorner(motion.X_WB_end);
  if (quiet) {
    quiet_speed = std::max(quiet_speed, speed);
    const Vec3& p = motion.X_WB_end.p;
    const bool inside = std::max(std::abs(p.x()), std::abs(p.y())) < kHalfBin;
    quiet_height = std::max(quiet_height, inside ? std::abs(height) : HUGE_VAL);
  }
  if (sample.tick.index % 30 != 0) return;
  const Vec3 w = motion.w_WB;
  const double mass = *scene.bodies[cube].mass, inertia = mass * kEdge * kEdge / 6;
  energy.x.push_back(sample.tick.time);
  energy.y.push_back(1000 * (mass * (motion.v_WB.squaredNorm() / 2 + 9.81 * (motion.X_WB_end.p.z() - kEdge / 2)) +
                             inertia * w.squaredNorm() / 2));
}

struct Play {
  std::uint64_t seed = 1;
  Method method;
};

std::vector<Finding> play(const Play& game) {
  const HandImpedance hand;
  RandomHand::Place place;
  place.half = kEdge / 2;
  place.radius = kRadius;
  place.low = {-0.19, -0.19, -0.005};
  place.high = {0.19, 0.19, 0.25};
  place.home = {Vec3(-0.1, 0, 0.3), Vec3(0.1, 0, 0.3)};
  place.stiffness = 1 / (1 / hand.stiffness + 1 / kStiffness);
  RandomHand player(place, game.seed);

  double clock = 0;
  std::array<Transport, 2> transports;
  DeviceList fingers;
  for (const std::size_t f : {0UL, 1UL}) {
    const auto target = [&player, f](double time) { return player.state(f, time); };
    fingers.push_back(std::make_unique<CompliantFinger>(hand, target, clock, transports[f]));
  }
  StudyRun run(specOf("endurance.xml", game.method.sets, kDuration), std::move(fingers));
  const std::size_t cube = bodyNamed(run.world(), "cube");
  Watch watch;
  for (auto* values : {&watch.energy.x, &watch.energy.y}) values->reserve(4096);
  run.delay([&](RateGroup, double time) {
    clock = time;
    return false;
  });
  run.observe([&](const HapticSample& sample) {
    watch.see(sample, run.world(), cube, player.quiet(sample.tick.time));
    player.look(sample.tick.time, sample.objects->poseAt(static_cast<std::int32_t>(cube), sample.tick.time));
    watch.passed = sample.contact.pop_through + sample.contact.coverage_lost;
    if (sample.tick.time < kWarm) watch.memory_warm = residentMemory();
  });
  run.run();
  watch.memory_end = residentMemory();

  Finding rest =
      finding("speed in the quiet moments", 1000 * watch.quiet_speed, "mm/s", 2,
              "the released cube comes to rest: no energy stays or grows over " + number(player.games()) + " games");
  rest.plot_x = "time [s]";
  rest.plot_y = "energy of the cube [mJ]";
  rest.curves.push_back(decimated(std::move(watch.energy)));
  return {finding("ticks with a fault", watch.faults + watch.passed, "", 0,
                  "no fault bit, no force past a limit, no surface passed, no watchdog"),
          rest,
          finding("proxy off every surface", 1e6 * watch.proxy_off, "um", 1,
                  "a touching fingertip's centre is one radius from a box, by the box's distance function"),
          finding("lowest corner off the floor then", 1000 * watch.quiet_height, "mm", 0.1,
                  "the cube lies on the floor of its bin, neither in the floor nor above it"),
          finding("memory grown", (watch.memory_end - watch.memory_warm) / 1e6, "MB", 1, "no memory leaks")};
}

}  // namespace

Case make() {
  Case result;
  result.name = "endurance";
  result.title = "Ten minutes of grabbing, throwing, pressing, shaking and groping, one minute per seed";
  result.source =
      "Seeded random motions of two compliant fingers around a cube in a bin; each game ends with a pause in which the "
      "state is known without simulation.";
  result.oracle =
      "After each game the cube lies still on the floor of its bin; no fault, no leak, no surface passed, and no "
      "proxy off a surface.";
  result.scene = "endurance.xml";
  const auto add = [&result](const Play& game, Verdict expected) {
    Trial trial;
    trial.parameters = {{"seed", number(static_cast<double>(game.seed))}};
    trial.method = game.method.name;
    trial.expected = expected;
    trial.run = [game] { return play(game); };
    trial.quick = game.seed == 1 && game.method.own();
    result.trials.push_back(std::move(trial));
  };
  for (std::uint64_t seed = 1; seed <= 10; ++seed) add({seed, ours()}, Verdict::kStable);
  for (std::uint64_t seed = 1; seed <= 2; ++seed) add({seed, explicitCoupling()}, Verdict::kUnstable);
  return result;
}

}  // namespace presa::stability::endurance
