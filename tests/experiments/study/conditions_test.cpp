// Conditions of a run: a line that delays, and ticks that are late.
#include "experiments/study/conditions.h"

#include <gtest/gtest.h>

#include <cmath>

#include "experiments/stability/wall_loop.h"
#include "experiments/study/energy_ledger.h"
#include "experiments/study/prescribed_finger.h"
#include "experiments/study/study_run.h"

namespace presa {
namespace {

const std::string kWall = PRESA_SOURCE_DIR "/experiments/stability/scenes/haptic_wall.xml";

/// Positions of a hand of 2 kg and 2 N s/m that leans on the wall, with the delay in itself and behind a line.
std::vector<double> leaning(int delay_of_plant, double latency) {
  DeviceList devices;
  devices.push_back(std::make_unique<stability::WallDevice>(
      stability::WallDevice::Setup{{2, 2, 0.001, delay_of_plant}, 1.0, -0.0085, 0.6, Vec3(0, 0, 0.1)}));
  StudyRun run({.scene = kWall,
                .sets = {"material/glass/stiffness=150"},
                .duration = 3,
                .conditions = {.latency = latency, .haptic = {}, .collision = {}, .dynamics = {}}},
               std::move(devices));
  std::vector<double> x;
  run.observe([&](const HapticSample& sample) { x.push_back(sample.device.fingers[0].p_WH.x()); });
  run.run();
  return x;
}

// The plant's own delay, held against the eigenvalues of the loop in the lectures, is the oracle.
TEST(Latency, IsTheDelayOfTheExactPlantToTheBit) {
  for (const int delay : {0, 1, 10}) {
    const std::vector<double> exact = leaning(delay, 0), behind = leaning(0, 0.001 * delay);
    ASSERT_EQ(exact, behind) << delay << " ms";
    EXPECT_GT(exact.back(), -0.008) << "the hand leans on the wall";
  }
  EXPECT_NE(leaning(0, 0), leaning(0, 0.001));
}

TEST(Latency, ShowsTheForceThatTheFingerFeels) {
  const auto forces = [](double latency) {
    DeviceList devices;
    devices.push_back(std::make_unique<PrescribedFinger>([](double time) {
      return PrescribedFinger::State{Vec3(-0.008 + 0.002 * std::sin(20 * time), 0, 0.1), Vec3::Zero()};
    }));
    StudyRun run({.scene = kWall,
                  .duration = 1,
                  .conditions = {.latency = latency, .haptic = {}, .collision = {}, .dynamics = {}}},
                 std::move(devices));
    std::vector<double> all;
    run.observe([&](const HapticSample& sample) { all.push_back(sample.command.f_H_W[0].x()); });
    run.run();
    return all;
  };
  const std::vector<double> now = forces(0), later = forces(0.007);
  EXPECT_EQ(std::vector<double>(7, 0.0), std::vector<double>(later.begin(), later.begin() + 7));
  EXPECT_TRUE(std::equal(later.begin() + 7, later.end(), now.begin()));
}

/// Receives the commands of its line.
class Receiver final : public Device {
 public:
  explicit Receiver(std::vector<double>& received) : received_(received) {}
  FingerInput read(const Tick&) noexcept override { return {}; }
  void write(const Wrench& F_H_W, const Tick&) noexcept override { received_.push_back(F_H_W.f.x()); }

 private:
  std::vector<double>& received_;
};

TEST(Latency, CommandsArriveDuringAStall) {
  std::vector<double> received;
  const std::unique_ptr<Device> device = behindLine(std::make_unique<Receiver>(received), 2);
  for (std::uint64_t i = 0; i < 8; ++i) {
    const Tick tick{.index = i, .time = 0.001 * static_cast<double>(i), .period = 0.001};
    device->read(tick);
    const bool stalled = i == 4 || i == 5;  // catch-up ticks send nothing: the device holds command 3
    if (!stalled) device->write(Wrench(Vec3(static_cast<double>(i), 0, 0)), tick);
  }
  EXPECT_EQ(received, (std::vector<double>{0, 0, 0, 1, 2, 3, 3, 3}));
}

// Late by 5 periods with probability s: a tick advances by 1 + 4 s periods in the mean, and no other advance is there.
TEST(LateTicks, TheShareOfThemIsLateByTheirPeriods) {
  Conditions conditions;
  conditions.haptic = {0.1, 5};
  LateTicks late(conditions, 1), again(conditions, 1);
  constexpr int kDue = 100'000;
  int run = 0, since = 0, five = 0;
  for (int due = 0; due < kDue; ++due) {
    EXPECT_FALSE(late(RateGroup::kDynamics));
    const bool waits = late(RateGroup::kHaptic);
    EXPECT_EQ(waits, again(RateGroup::kHaptic));
    ++since;
    if (waits) continue;
    EXPECT_TRUE(since == 1 || since == 5) << since;
    five += since == 5 ? 1 : 0;
    since = 0;
    ++run;
  }
  // binomial: standard deviation sqrt(0.09 / 71 000) = 0.0011
  EXPECT_NEAR(1.0 * five / run, 0.1, 4 * 0.0011);
}

// With every tick late, the finger holds a force for five periods; the force of the newest tick is right.
TEST(LateTicks, AForceIsHeldUntilTheLateTick) {
  DeviceList devices;
  devices.push_back(std::make_unique<PrescribedFinger>([](double time) {
    return PrescribedFinger::State{Vec3(-0.008 + 0.001 * time, 0, 0.1), Vec3(0.001, 0, 0)};
  }));
  StudyRun run(
      {.scene = kWall, .duration = 2, .conditions = {.latency = 0, .haptic = {1, 5}, .collision = {}, .dynamics = {}}},
      std::move(devices));
  std::vector<double> force, depth;
  run.observe([&](const HapticSample& sample) {
    force.push_back(sample.command.f_H_W[0].x());
    depth.push_back(sample.device.fingers[0].p_WH.x() + 0.008);
  });
  run.run();
  const double stiffness = run.world().scene.materials[0].stiffness;
  for (std::size_t i = 1500; i < force.size(); ++i) {
    const bool newest = i % 5 == 0;
    if (newest)
      EXPECT_NEAR(force[i], -stiffness * depth[i], 1e-9 * stiffness) << i;
    else
      EXPECT_EQ(force[i], force[i - 1]) << i;
  }
}

// A cube falls in exact steps of 5 ms. Several steps between two observations leave the velocities too old.
TEST(EnergyLedger, JudgesNoStepWhosePredecessorItHasNotSeen) {
  const StudyRun cube({.scene = PRESA_SOURCE_DIR "/config/scenes/cube.xml"});
  const auto world = std::make_shared<const World>(cube.world());
  EnergyLedger ledger(world);
  constexpr double kStep = 0.005, kGravity = 9.81;
  const auto height = [](double time) { return 1 - 0.5 * kGravity * time * time; };
  ObjectState objects;
  objects.bodies.resize(world->scene.bodies.size());
  const DeviceState device(world->scene.devices.size());
  const ContactExchange contact(world->scene.devices.size());
  const ForceCommand command(world->scene.devices.size());
  for (const std::uint64_t step : {0, 1, 2, 3, 8, 9, 10, 30, 31}) {
    const double time = kStep * static_cast<double>(step);
    objects.time_begin = time;
    objects.time_end = time + kStep;
    objects.bodies[1].X_WB_begin.p.z() = height(time);
    objects.bodies[1].v_WB.z() = -kGravity * objects.time_end;
    const Tick tick{.index = 5 * step, .time = time, .period = 0.001};
    ledger.observe({tick, device, contact, command, &objects, step + 1});
  }
  EXPECT_LT(ledger.created(), 1e-9);
}

}  // namespace
}  // namespace presa
