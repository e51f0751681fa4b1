#include "framework/record/monitor/monitor.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "tests/framework/record/monitor/synthetic_run.h"

// counts the allocations of the whole program
namespace {
std::atomic<std::uint64_t> allocations{0};
}
// noinline: gcc would otherwise pair the library's new with the free below and warn
[[gnu::noinline]] void* operator new(std::size_t size) {
  allocations.fetch_add(1, std::memory_order_relaxed);
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace presa {
namespace {

using test::Feed;
using test::kCube;
using test::pinchWorld;

// step runs a thousand times a second on the haptic thread, so all its memory is allocated before.
TEST(Monitor, TickNeverAllocates) {
  Feed feed(0.5, 0.2, 1000);
  const std::uint64_t before = allocations.load();
  // slip onsets and trace both run past their capacity here
  for (int i = 0; i < 600; ++i) {
    feed.touch(0, i % 2 == 0 ? ContactMode::kStick : ContactMode::kSlip);
    feed.place(Vec3(0, 0, 0.035 + 1e-4 * i));
    feed.tick();
  }
  EXPECT_EQ(allocations.load(), before);
  EXPECT_EQ(feed.monitor.slipOnsets(0).size(), kMaxSlipOnsets);
  EXPECT_EQ(feed.monitor.fingers()[0].slip_onsets, 300u);
}

// Faults are kept with the time of their first tick, per finger where the contact state allows it.
TEST(Monitor, KeepsWhenASurfaceWasFirstLostAndFirstPassed) {
  Feed feed(1);
  feed.ticks(100);
  EXPECT_EQ(feed.monitor.coverageLost(), 0u);
  EXPECT_EQ(feed.monitor.firstCoverageLost(), -1);
  EXPECT_EQ(feed.monitor.fingers()[1].first_pop_through, -1);
  for (std::uint32_t lost = 1; lost <= 37; ++lost) {
    feed.contact.coverage_lost = lost;
    feed.tick();
  }
  feed.contact.pop_through = feed.contact.pop_through_by_finger[1] = 2;
  feed.ticks(100);
  EXPECT_EQ(feed.monitor.coverageLost(), 37u);
  EXPECT_DOUBLE_EQ(feed.monitor.firstCoverageLost(), 0.100);
  EXPECT_EQ(feed.monitor.fingers()[1].pop_through, 2u);
  EXPECT_DOUBLE_EQ(feed.monitor.fingers()[1].first_pop_through, 0.137);
  EXPECT_EQ(feed.monitor.fingers()[0].first_pop_through, -1);
}

// The times in the three modes add up to the run. 1e-12 s is the rounding of 400 additions of 1 ms.
TEST(Monitor, SecondsByModeAddUpAndForcesAreOverTheTicksInContact) {
  Feed feed(1);
  feed.ticks(100);
  feed.touch(0, ContactMode::kStick, 2);
  feed.ticks(150);
  feed.touch(0, ContactMode::kSlip, 5);
  feed.ticks(50);
  feed.touch(0, ContactMode::kNone);
  feed.ticks(100);
  const FingerSummary& sum = feed.monitor.fingers()[0];
  EXPECT_NEAR(sum.seconds[0], 0.200, 1e-12);
  EXPECT_NEAR(sum.seconds[1], 0.150, 1e-12);
  EXPECT_NEAR(sum.seconds[2], 0.050, 1e-12);
  EXPECT_EQ(sum.max_normal_force, 5);
  EXPECT_DOUBLE_EQ(sum.mean_normal_force, (150 * 2 + 50 * 5) / 200.0);
  EXPECT_EQ(feed.monitor.simulatedTime(), 400 * 0.001);
}

// A grasp requires two fingers in the same tick, not one after the other.
TEST(Monitor, GraspNeedsTwoFingersAtOnce) {
  Feed feed(1);
  feed.touch(0, ContactMode::kStick);
  feed.ticks(10);
  feed.touch(0, ContactMode::kNone);
  feed.touch(1, ContactMode::kStick);
  feed.ticks(10);
  EXPECT_FALSE(feed.monitor.objects()[kCube].grasped);
  feed.touch(0, ContactMode::kSlip);
  feed.tick();
  EXPECT_TRUE(feed.monitor.objects()[kCube].grasped);
}

// Two fingers on two different bodies grasp neither.
TEST(Monitor, FingersOnDifferentBodiesGraspNothing) {
  Feed feed(1);
  feed.touch(0, ContactMode::kStick);
  feed.touch(1, ContactMode::kStick);
  feed.contact.fingers[1].body = 0;
  feed.ticks(10);
  EXPECT_FALSE(feed.monitor.objects()[kCube].grasped);
  EXPECT_FALSE(feed.monitor.objects()[0].grasped);
}

// A loss after the scripted release is intended; a loss before it is a failure of the grasp.
TEST(Monitor, LossCountsAsADropOnlyBeforeTheRelease) {
  for (const bool early : {true, false}) {
    Feed feed(1, 0.100);
    feed.touch(0, ContactMode::kStick);
    feed.touch(1, ContactMode::kStick);
    feed.ticks(early ? 99 : 100);
    feed.touch(0, ContactMode::kNone);
    feed.tick();  // one finger left: not lost yet
    EXPECT_LT(feed.monitor.objects()[kCube].lost_at, 0);
    feed.touch(1, ContactMode::kNone);
    if (early) feed.index -= 1;  // the loss falls on 0.099 s, one tick before the loosening
    feed.ticks(50);
    const ObjectSummary& cube = feed.monitor.objects()[kCube];
    EXPECT_DOUBLE_EQ(cube.lost_at, early ? 0.099 : 0.101);
    EXPECT_EQ(cube.dropped, early);
  }
}

// A motion that never lets go drops whatever it loses; of one that says nothing, no loss is a drop.
TEST(Monitor, OnlyAMotionWithIntentsDrops) {
  for (const bool said : {true, false}) {
    Feed feed(1, said ? std::numeric_limits<double>::infinity() : std::numeric_limits<double>::quiet_NaN());
    for (std::size_t f = 0; f < 2; ++f) feed.touch(f, ContactMode::kStick);
    feed.ticks(100);
    for (std::size_t f = 0; f < 2; ++f) feed.touch(f, ContactMode::kNone);
    feed.ticks(100);
    EXPECT_DOUBLE_EQ(feed.monitor.objects()[kCube].lost_at, 0.1);
    EXPECT_EQ(feed.monitor.objects()[kCube].dropped, said);
  }
}

// While forces fade after a stop, the hand closes on what no longer pushes back: 33 N rendered then, and the loss, say
// nothing about the grasp. What the device was sent counts in every tick.
TEST(Monitor, CountsWhatWasRenderedUntilAStopOnly) {
  Feed feed(1, std::numeric_limits<double>::infinity());
  for (std::size_t f = 0; f < 2; ++f) feed.touch(f, ContactMode::kStick, 6);
  feed.command.f_H_W[0] = Vec3(0, 0, 6);
  feed.ticks(100);
  EXPECT_EQ(feed.monitor.stoppedAt(), -1);
  feed.device.stop_requested = true;
  for (std::size_t f = 0; f < 2; ++f) feed.touch(f, ContactMode::kStick, 33);
  feed.command.f_H_W[0] = Vec3(0, 7, 0);
  feed.ticks(50);
  for (std::size_t f = 0; f < 2; ++f) feed.touch(f, ContactMode::kSlip, 33);
  feed.tick();
  for (std::size_t f = 0; f < 2; ++f) feed.touch(f, ContactMode::kNone);
  feed.ticks(50);
  const FingerSummary& thumb = feed.monitor.fingers()[0];
  EXPECT_DOUBLE_EQ(feed.monitor.stoppedAt(), 0.1);
  EXPECT_EQ(thumb.max_normal_force, 6);
  EXPECT_DOUBLE_EQ(thumb.mean_normal_force, 6);
  EXPECT_EQ(thumb.max_commanded_force, 7);
  EXPECT_EQ(thumb.slip_onsets, 0u);
  EXPECT_LT(feed.monitor.objects()[kCube].lost_at, 0);
}

// A short bounce after closing is no loss; a longer interruption is one, from its first tick.
TEST(Monitor, ABounceIsNoLoss) {
  for (const int away : {20, 80}) {
    Feed feed(1, 10);
    const auto both = [&](ContactMode mode, int ticks) {
      feed.touch(0, mode);
      feed.touch(1, mode);
      feed.ticks(ticks);
    };
    both(ContactMode::kStick, 10);
    both(ContactMode::kNone, away);
    both(ContactMode::kStick, 10);
    const ObjectSummary& cube = feed.monitor.objects()[kCube];
    EXPECT_EQ(cube.dropped, away == 80);
    EXPECT_DOUBLE_EQ(cube.lost_at, away == 80 ? 0.010 : -1.0);
  }
}

// Between two dynamics steps the object's pose is interpolated to the time of the tick.
TEST(Monitor, ObjectIsTakenAtTheTimeOfTheTick) {
  Feed feed(1, 1, 1000);
  feed.ticks(2);
  feed.objects.time_begin = 0.000;
  feed.objects.time_end = 0.005;
  feed.objects.bodies[kCube].X_WB_begin.p = Vec3(0, 0, 0.035);
  feed.objects.bodies[kCube].X_WB_end.p = Vec3(0, 0, 0.040);
  feed.objects.bodies[kCube].v_WB = Vec3(0.3, 0, 0.4);
  ++feed.version;
  feed.tick();  // 2 ms into the step of 5 ms
  const ObjectSummary& cube = feed.monitor.objects()[kCube];
  EXPECT_NEAR(cube.final.z(), 0.037, 1e-17);  // one rounding of a number near 0.04
  EXPECT_NEAR(feed.monitor.trace()[2].bodies[0].p.z(), 0.037, 1e-17);
  EXPECT_DOUBLE_EQ(cube.peak_speed, 0.5);
  feed.place(Vec3(0, 0, 0.010));
  feed.tick();
  EXPECT_NEAR(cube.highest.z(), 0.037, 1e-17);
  EXPECT_EQ(cube.final.z(), 0.010);
  EXPECT_EQ(cube.start.z(), 0.035);
}

// Without moving bodies there is no dynamics, and bodies keep their start poses.
TEST(Monitor, WithoutDynamicsObjectsRest) {
  Feed feed(1, 1, 1000);
  for (int i = 0; i < 5; ++i) feed.tick(false);
  const ObjectSummary& cube = feed.monitor.objects()[kCube];
  EXPECT_EQ(cube.final, Vec3(0, 0, 0.035));
  EXPECT_EQ(cube.highest, Vec3(0, 0, 0.035));
  EXPECT_EQ(cube.peak_speed, 0);
  EXPECT_EQ(feed.monitor.trace().end()[-1].bodies[0].p, Vec3(0, 0, 0.035));
}

// The trace is decimated, slip detection is not: the onset carries the forces of its tick and of the tick before.
TEST(Monitor, SlipOnsetIsLatchedAtHapticRate) {
  Feed feed(1, 0.020, 10);
  feed.touch(1, ContactMode::kStick, 3.0, 0.9);
  feed.ticks(7);
  feed.touch(1, ContactMode::kSlip, 2.9, 1.7);
  feed.ticks(3);
  feed.touch(1, ContactMode::kStick, 2.0, 1.0);
  feed.ticks(20);
  feed.touch(1, ContactMode::kStick, 1.25, 0.98);
  feed.tick();
  feed.touch(1, ContactMode::kSlip, 1.20, 0.72);
  feed.ticks(5);
  const auto& slips = feed.monitor.slipOnsets(1);
  ASSERT_EQ(slips.size(), 2u);
  EXPECT_DOUBLE_EQ(slips[0].time, 0.007);
  EXPECT_EQ(slips[0].last_stick_normal_force, 3.0);
  const SlipOnset& release = feed.monitor.fingers()[1].release_slip;
  EXPECT_DOUBLE_EQ(release.time, 0.031);
  EXPECT_EQ(release.body, kCube);
  EXPECT_EQ(release.normal_force, 1.20);
  EXPECT_DOUBLE_EQ(release.tangential_force, 0.72);
  EXPECT_EQ(release.last_stick_normal_force, 1.25);
  EXPECT_DOUBLE_EQ(release.last_stick_tangential_force, 0.98);
  EXPECT_TRUE(feed.monitor.slipOnsets(0).empty());
}

// Early chatter fills the list of onsets; the first slip after the loosening is kept all the same.
TEST(Monitor, ReleaseSlipSurvivesAFullList) {
  Feed feed(1, 0.300);
  for (int i = 0; i < 300; ++i) {
    feed.touch(0, i % 2 == 0 ? ContactMode::kStick : ContactMode::kSlip);
    feed.tick();
  }
  feed.touch(0, ContactMode::kStick, 2);
  feed.tick();
  feed.touch(0, ContactMode::kSlip, 1.5);
  feed.tick();
  EXPECT_EQ(feed.monitor.slipOnsets(0).size(), kMaxSlipOnsets);
  EXPECT_DOUBLE_EQ(feed.monitor.fingers()[0].release_slip.time, 0.301);
  EXPECT_EQ(feed.monitor.fingers()[0].release_slip.normal_force, 1.5);
}

// The trace rate is approximate: samples lie on ticks, and a very long run is sampled more sparsely.
TEST(Monitor, TraceIsDecimatedEvenlyAndBounded) {
  Feed feed(0.5, 1, 250);
  feed.ticks(500);
  const auto& trace = feed.monitor.trace();
  ASSERT_EQ(trace.size(), 125u);
  for (std::size_t i = 0; i < trace.size(); ++i) EXPECT_DOUBLE_EQ(trace[i].time, 0.004 * static_cast<double>(i));
  EXPECT_TRUE(Feed(0.5, 1, 0).monitor.trace().empty());
  EXPECT_LE(Feed(86'400, 1, 1000).monitor.trace().capacity(), 40'000u);
}

}  // namespace
}  // namespace presa
