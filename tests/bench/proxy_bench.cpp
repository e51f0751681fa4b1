#include <benchmark/benchmark.h>

#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "tests/bench/lap_timer.h"
#include "tests/bench/touched.h"

// Cost of a haptic tick, of a step of the collision thread, and of both together, while fingers slide over a body, with
// the modules in a graph as in a run. bound_bench.cpp has the lower bound.
namespace presa::bench {
namespace {

constexpr int kPasses = 5;

/// Creates a rig. It is recreated only for another benchmark, because Google Benchmark calls each several times.
using MakeRig = std::function<std::unique_ptr<Rig>()>;
Rig& rigOf(const std::string& name, const MakeRig& make) {
  static std::string made;
  static std::unique_ptr<Rig> rig;
  if (made != name) {
    rig.reset();  // free the previous rig first
    rig = make();
    made = name;
  }
  return *rig;
}

/// Checks that the fingers touch and slip, and that every lap gives the same forces.
struct Watched {
  explicit Watched(std::size_t ticks) : first(ticks, Vec3::Zero()) {}
  void look(std::size_t tick, const ContactExchange& contacts, bool first_pass) {
    for (std::size_t f = 0; f < contacts.fingers.size(); ++f) {
      touching += contacts.fingers[f].mode != ContactMode::kNone;
      slipping += contacts.fingers[f].mode == ContactMode::kSlip;
      ++looks;
    }
    if (first_pass) first[tick] = contacts.fingers[0].f_H_W;
    differing += first[tick] != contacts.fingers[0].f_H_W;
  }
  std::vector<Vec3> first;  // force on the first finger
  double looks = 0, touching = 0, slipping = 0, differing = 0;
};

void report(benchmark::State& state, const Windows& blocks, const Windows& singles, double per_block) {
  state.counters["p50_us"] = blocks.own(0.5) / per_block;
  state.counters["mean_us"] = blocks.mean() / per_block;
  state.counters["p99_us"] = singles.own(0.99);
  state.counters["p99_raw_us"] = singles.raw(0.99);
}

void report(benchmark::State& state, const Watched& watched) {
  state.counters["slipping"] = watched.slipping / watched.looks;
  state.counters["differing"] = watched.differing;
  state.counters["touching"] = watched.touching / watched.looks;
  if (watched.touching == 0) state.SkipWithError("the finger touches nothing");
}

/// p50_us and mean_us over blocks of the five ticks between two steps of the dynamics, because reading the clock costs
/// a good part of a tick; p99_us over single ticks.
void hapticTick(benchmark::State& state, const std::string& name, const MakeRig& make) {
  Rig& rig = rigOf(name, make);
  const auto lap = static_cast<std::size_t>(rig.lap());
  Windows singles(lap), blocks(lap / Rig::kDynamics);
  Watched watched(lap);
  const auto others = [&](std::ptrdiff_t t) {
    if (t % Rig::kDynamics == 0) rig.moveBodies(t);
    if (t % Rig::kCollision == 0) rig.collide(t);
  };
  bool first = true;
  for (auto _ : state) {
    for (int pass = 0; pass < kPasses; ++pass) {
      rig.comeDown();
      for (std::ptrdiff_t t = 0; t < rig.lap(); ++t) {
        others(t);
        rig.moveFingers(t);
        const auto i = static_cast<std::size_t>(t);
        singles.add(i, cpuNsOf([&] { rig.haptic(t); }));
        watched.look(i, rig.contacts(), first);
      }
      first = false;
      rig.comeDown();
      for (std::ptrdiff_t t = 0; t < rig.lap(); t += Rig::kDynamics) {
        others(t);
        blocks.add(static_cast<std::size_t>(t / Rig::kDynamics), cpuNsOf([&] {
                     for (std::ptrdiff_t i = t; i < t + Rig::kDynamics; ++i) {
                       rig.moveFingers(i);
                       rig.haptic(i);
                     }
                   }));
      }
    }
  }
  report(state, blocks, singles, Rig::kDynamics);
  report(state, watched);
}

/// Processor time of haptic and collision group together per simulated ms, over periods of the collision group.
void bothThreads(benchmark::State& state, const std::string& name, const MakeRig& make) {
  Rig& rig = rigOf(name, make);
  Windows periods(static_cast<std::size_t>(rig.lap() / Rig::kCollision));
  for (auto _ : state) {
    for (int pass = 0; pass < kPasses; ++pass) {
      rig.comeDown();
      for (std::ptrdiff_t t = 0; t < rig.lap(); t += Rig::kCollision) {
        rig.moveBodies(t);
        periods.add(static_cast<std::size_t>(t / Rig::kCollision), cpuNsOf([&] {
                      rig.collide(t);
                      for (std::ptrdiff_t i = t; i < t + Rig::kCollision; ++i) {
                        rig.moveFingers(i);
                        rig.haptic(i);
                      }
                    }));
      }
    }
  }
  const double ms = Rig::kCollision;
  state.counters["p50_us"] = periods.own(0.5) / ms;
  state.counters["p99_us"] = periods.own(0.99) / ms;
  state.counters["mean_us"] = periods.mean() / ms;
}

/// A step of the collision group alone.
void collisionStep(benchmark::State& state, const std::string& name, const MakeRig& make) {
  Rig& rig = rigOf(name, make);
  Windows steps(static_cast<std::size_t>(rig.lap() / Rig::kCollision));
  for (auto _ : state) {
    for (int pass = 0; pass < kPasses; ++pass) {
      rig.comeDown();
      for (std::ptrdiff_t t = 0; t < rig.lap(); ++t) {
        if (t % Rig::kDynamics == 0) rig.moveBodies(t);
        if (t % Rig::kCollision == 0) {
          steps.add(static_cast<std::size_t>(t / Rig::kCollision), cpuNsOf([&] { rig.collide(t); }));
        }
        rig.moveFingers(t);
        rig.haptic(t);
      }
    }
  }
  report(state, steps, steps, 1);
}

/// A square grid of bodies 0.15 m apart, every tenth of them swinging and the others asleep; one in the middle is
/// touched.
std::unique_ptr<Rig> manyBodies(int count, Touched body, Motion motion) {
  const int side = static_cast<int>(std::ceil(std::sqrt(count)));
  std::vector<Touched> bodies;
  body.fixed = false;
  for (int i = 0; i < count; ++i) {
    const int row = i / side;
    body.p_WB = 0.15 * Vec3(i % side, row, 0);
    bodies.push_back(body);
    if (i % 10 == 5) motion.swinging.push_back(static_cast<std::size_t>(i));
  }
  const int middle = side / 2 * (side + 1);
  motion.carrier = static_cast<std::size_t>(middle);
  return std::make_unique<Rig>(worldOf(bodies, 8e-3), std::move(motion));
}

/// A fingertip of 8 mm radius moving in a circle on top of one of many boxes.
std::unique_ptr<Rig> manyBoxes(int count) {
  constexpr double kEdge = 0.06, kCircle = 0.02;
  Motion motion;
  motion.lap = static_cast<std::size_t>(10 * std::round(2 * std::numbers::pi * kCircle / (kSpeed * 1e-3) / 10));
  motion.p_BH = [lap = motion.lap](std::size_t, std::size_t tick, double height) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(tick) / static_cast<double>(lap);
    return Vec3(kCircle * std::cos(angle), kCircle * std::sin(angle), kEdge / 2 + 8e-3 - kDepth + height);
  };
  return manyBodies(count, {.mesh = nullptr, .box = Vec3::Constant(kEdge)}, std::move(motion));
}

std::unique_ptr<Rig> sphereRig(int triangles, double radius, bool moving, int fingers = 1, bool bumpy = false) {
  Motion motion = aroundSphere(radius);
  if (moving) motion.swinging = {0};
  const Touched body{.mesh = sphereMesh(triangles, bumpy), .fixed = !moving};
  return std::make_unique<Rig>(worldOf({body}, radius, fingers), std::move(motion));
}

/// Another renderer, with a fingertip of 0.1 mm: fca_mesh holds a point.
std::unique_ptr<Rig> renderedSphere(const std::string& renderer, int triangles) {
  constexpr double kRadius = 1e-4;
  return std::make_unique<Rig>(worldOf({{.mesh = sphereMesh(triangles)}}, kRadius, 1, renderer), aroundSphere(kRadius));
}

/// A line of 1 mm radius lies along the way of the hand; beside it the god-object with a fingertip of the same radius.
std::unique_ptr<Rig> lineOnSphere(int triangles) {
  constexpr double kRadius = 1e-3;
  return std::make_unique<Rig>(worldOfLine({{.mesh = sphereMesh(triangles)}}, kRadius, "ray"), aroundSphere(kRadius));
}

using Measure = void (*)(benchmark::State&, const std::string&, const MakeRig&);
void add(const std::string& name, Measure measure, const MakeRig& make) {
  benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
    measure(state, name, make);
  })->Unit(benchmark::kMillisecond);
}

const bool kProxyRegistered = [] {
  const std::pair<const char*, double> radii[] = {{"r0", 0}, {"r0p1mm", 1e-4}, {"r1mm", 1e-3}, {"r8mm", 8e-3}};
  for (const int n : {20'480, 327'680, 1'310'720}) {
    const std::string sphere = "sphere_" + std::to_string(n);
    for (const auto& [size, radius] : radii) {
      for (const bool moving : {false, true}) {
        add("proxy_tick/" + sphere + "/" + size + (moving ? "/moving" : "/still"), hapticTick,
            [=, radius = radius] { return sphereRig(n, radius, moving); });
      }
    }
    for (const std::string renderer : {"god_object", "scp", "fca_mesh", "penalty", "intermediate"}) {
      add("renderer/" + renderer + "/" + sphere, hapticTick, [=] { return renderedSphere(renderer, n); });
    }
    add("renderer/ray/" + sphere, hapticTick, [=] { return lineOnSphere(n); });
    add("patch_gather/" + sphere, collisionStep, [=] { return sphereRig(n, 8e-3, false); });
  }
  add("proxy_tick/sphere_327680/r8mm/two_fingers", hapticTick, [] { return sphereRig(327'680, 8e-3, false, 2); });
  for (const auto& [size, radius] : {radii[2], radii[3]}) {
    add(std::string("both_threads/sphere_327680/") + size, bothThreads,
        [radius = radius] { return sphereRig(327'680, radius, false); });
  }
  for (const int count : {256, 5000}) {
    const std::string bodies = std::to_string(count);
    add("proxy_tick/boxes_" + bodies, hapticTick, [=] { return manyBoxes(count); });
    add("broad_phase/" + bodies, collisionStep,
        [=] { return manyBodies(count, {.mesh = sphereMesh(320)}, aroundSphere(8e-3)); });
  }
  add("BM_HapticTickTwoFingers/20480", hapticTick, [] { return sphereRig(20'480, 8e-3, true, 2, true); });
  return true;
}();

}  // namespace
}  // namespace presa::bench
