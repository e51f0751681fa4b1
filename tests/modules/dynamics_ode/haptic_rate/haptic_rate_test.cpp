// Bodies that the haptic thread moves while fingers hold them: taken over and given back without a step, groups as a
// whole, and nothing of it in a run that does not ask.
#include <gtest/gtest.h>

#include "modules/dynamics_ode/haptic_rate/gentle_return.h"
#include "tests/modules/dynamics_ode/haptic_rate/held_bench.h"
#include "tests/support/edited.h"

namespace presa::held {
namespace {

/// Thumb (-1) and index (1) close on a cube at the origin, carry it along y from 0.5 s on at 0.1 m/s, open at 1.2 s
/// and close again at 1.6 s where it has flown meanwhile.
PrescribedFinger::Path carrying(double side) {
  return along([side](double t) {
    const double gap = 0.003 - (0.003 + kDepth) * (smooth(t, 0.05, 0.3) - smooth(t, 1.2, 1.25) + smooth(t, 1.6, 1.7));
    const double y = t < 0.7 ? 0.1 * 0.2 * std::pow(std::max(0.0, t - 0.5) / 0.2, 2) / 2 : 0.01 + 0.1 * (t - 0.7);
    return Vec3(side * (kHalf + kRadius + gap), y, 0.02);
  });
}

/// They lift it by 0.3 m until 1.1 s and open at 1.2 s.
PrescribedFinger::Path lifting(double side) {
  return along([side](double t) {
    const double gap = 0.003 - (0.003 + kDepth) * (smooth(t, 0.05, 0.3) - smooth(t, 1.2, 1.25));
    return Vec3(side * (kHalf + kRadius + gap), 0, 0.02 + 0.3 * smooth(t, 0.5, 1.1));
  });
}

// In free space a cube that the fingers let go flies on in a straight line: the haptic thread moves it, then both, then
// the dynamics. Neither its pose nor its velocity has a step, and the tick never allocates, locks or calls the system.
TEST(HeldAtHapticRate, ABodyComesAndGoesWithoutAStep) {
  Bench bench(cubesXml({0}, false), {carrying(-1), carrying(1)});
  std::optional<BodyMotion> before;
  double off_path = 0, jump = 0, flies = 0;
  std::size_t held = 0, given_back = 0, free = 0;
  bench.eye->look = [&](const Tick& tick) {
    const BodyMotion& now = bench.cube(0);
    const auto& bodies = bench.eye->held->bodies;
    const bool touched = bench.eye->contact->fingers[0].mode != ContactMode::kNone;
    held += bodies.size() == 1 && bodies[0].phase == ode::HeldBody::Phase::kHeld ? 1 : 0;
    given_back += bodies.size() == 1 && bodies[0].phase == ode::HeldBody::Phase::kGivenBack ? 1 : 0;
    free += bodies.empty() ? 1 : 0;
    const Vec3 p = bench.eye->shown->poseAt(0, tick.time).p;
    BodyMotion moved = now;
    moved.X_WB_end.p = p;
    if (before && !touched && tick.time > 1.3 && tick.time < 1.6) {
      off_path = std::max(off_path, (p - before->X_WB_end.p - kTick * now.v_WB).norm());
      jump = std::max(jump, (now.v_WB - before->v_WB).norm());
      flies = now.v_WB.y();
    }
    before = moved;
  };
  test::GuardedSteps steps(*bench.session);
  steps.run(2500);
  EXPECT_EQ(steps.violation(RateGroup::kHaptic), "");
  EXPECT_EQ(steps.violation(RateGroup::kDynamics), "");
  EXPECT_NEAR(flies, 0.1, 0.01);
  EXPECT_LT(off_path, 1e-9);
  EXPECT_LT(jump, 1e-6);
  EXPECT_EQ(bench.eye->held->taken, 2U);
  EXPECT_GT(held, 1500U);
  EXPECT_NEAR(static_cast<double>(given_back), 1000 * ode::GentleReturn::kTime, 2);
  EXPECT_GT(free, 300U);
  // caught again: still in the fingers, and at their speed
  EXPECT_EQ(bench.eye->contact->fingers[0].mode, ContactMode::kStick);
  EXPECT_NEAR(bench.cube(0).v_WB.y(), 0.1, 1e-3);
}

// A flicked cube flies off with the impulse that the finger felt, to rounding: the force begins and ends within a tick, and
// the hand stops within one. Wherever in a step of the dynamics the touch begins, nothing is given twice or lost.
TEST(HeldAtHapticRate, ABodyGetsExactlyWhatTheFingerFelt) {
  constexpr double kSpeed = 0.5, kStop = 0.005, kCube = 0.1;  // of the finger [m/s, m], of the cube [kg]
  for (int later = 0; later < 5; ++later) {                   // ticks
    const auto flick = along([=](double t) {
      const double x = -0.0031 + kSpeed * (t - later * kTick);
      return Vec3(std::min(x, kStop) - kHalf - kRadius, 0, 0.02);
    });
    Bench bench(cubesXml({0}, false), {flick, along([](double) { return Vec3(1, 0, 0.02); })});
    Vec3 felt = Vec3::Zero();
    std::size_t ticks = 0, after = 0;
    double first = 0;
    bench.eye->look = [&](const Tick& tick) {
      const FingerContact& finger = bench.eye->contact->fingers[0];
      if (finger.mode != ContactMode::kNone) {
        first = ticks++ == 0 ? finger.f_H_W.norm() : first;
        felt += tick.period * finger.f_H_W;
      } else if (ticks > 0) {
        ++after;
      }
    };
    test::GuardedSteps steps(*bench.session);
    for (int tick = 0; tick < 200 && after < 3; ++tick) steps.run(1);
    ASSERT_EQ(after, 3U);
    ASSERT_EQ(bench.eye->held->bodies.size(), 1U);
    ASSERT_EQ(bench.eye->held->bodies[0].phase, ode::HeldBody::Phase::kHeld);
    EXPECT_GT(first, 1);  // [N]
    const Vec3 momentum = kCube * bench.cube(0).v_WB;
    EXPECT_GT(momentum.norm(), 0.05);
    EXPECT_LT((momentum + felt).norm(), 1e-12 * momentum.norm()) << "touched " << later << " ticks later";
  }
}

// Fingers that come back while the body is given back take it over again.
TEST(HeldAtHapticRate, ABodyIsTakenAgainOnItsWayBack) {
  const auto tapping = [](double side) {
    return along([side](double t) {
      const double gap = 0.003 - (0.003 + kDepth) * (smooth(t, 0.05, 0.3) - smooth(t, 1, 1.01) + smooth(t, 1.07, 1.1));
      return Vec3(side * (kHalf + kRadius + gap), 0, 0.02);
    });
  };
  Bench bench(cubesXml({0}, false), {tapping(-1), tapping(1)});
  std::size_t returning = 0;
  bench.eye->look = [&](const Tick&) {
    const auto& bodies = bench.eye->held->bodies;
    returning += bodies.size() == 1 && bodies[0].phase == ode::HeldBody::Phase::kGivenBack ? 1 : 0;
  };
  test::GuardedSteps steps(*bench.session);
  steps.run(1300);
  EXPECT_EQ(steps.violation(RateGroup::kHaptic), "");
  EXPECT_GT(returning, 5U);
  EXPECT_LT(returning, 45U);
  EXPECT_EQ(bench.eye->held->taken, 2U);
  EXPECT_EQ(bench.eye->held->too_many, 0U);
  ASSERT_EQ(bench.eye->held->bodies.size(), 1U);
  EXPECT_EQ(bench.eye->held->bodies[0].phase, ode::HeldBody::Phase::kHeld);
}

// Fingers that touch one of a joined pair again just as the pair is on its way back take both, in whichever tick it is.
TEST(HeldAtHapticRate, AJoinedPairIsTakenAgainAsOne) {
  std::size_t most_leaving = 0;
  for (int later = 0; later < 8; ++later) {  // ticks
    const auto tapping = [=](double side) {
      return along([=](double t) {
        const double back = 1.048 + later * kTick;
        const double gap = 0.003 - (0.003 + kDepth) * (smooth(t, 0.05, 0.3) - (t < 1 ? 0 : 1) + (t < back ? 0 : 1));
        return Vec3(side * (kHalf + kRadius + gap), 0, 0.02);
      });
    };
    std::string xml = cubesXml({0, 0.1, 0.5}, false);
    xml = test::edited(xml, "0.100000 0 0.02", "0 0.05 0.02");
    xml = test::edited(xml, "<body name=\"cube2\"", "<body name=\"cube2\" velocity=\"0 0 1\"");  // keeps dynamics busy
    xml = test::edited(xml, "<devices>", "<joint name=\"hold\" type=\"fixed\" body=\"cube1\" to=\"cube0\"/><devices>");
    Bench bench(xml, {tapping(-1), tapping(1)});
    std::size_t split = 0, together = 0, leaving = 0;
    bench.eye->look = [&](const Tick&) {
      const auto& bodies = bench.eye->held->bodies;
      const auto count = [&](ode::HeldBody::Phase phase) {
        return std::ranges::count_if(bodies, [&](const ode::HeldBody& body) { return body.phase == phase; });
      };
      split += count(ode::HeldBody::Phase::kHeld) == 1 ? 1 : 0;
      together += count(ode::HeldBody::Phase::kHeld) == 2 ? 1 : 0;
      leaving += count(ode::HeldBody::Phase::kLeaving) == 2 ? 1 : 0;
    };
    test::GuardedSteps steps(*bench.session);
    steps.run(1200);
    EXPECT_EQ(split, 0U) << later;
    EXPECT_GT(together, 900U) << later;
    most_leaving = std::max(most_leaving, leaving);
  }
  EXPECT_GE(most_leaving, 3U);  // it was on its way
}

// A cube that a finger has flicked against another one gives it half of its momentum, less what the floor takes in the
// two ticks of the impact, 8 mm/s each. It has taken the other over before they meet: else one of them would have been
// an obstacle for the other.
TEST(HeldAtHapticRate, AThrownBodyGivesAnotherHalfOfItsMomentum) {
  constexpr double kSpeed = 0.5, kStop = 0.06;  // of the finger [m/s, m]
  const auto flick = along(
      [](double t) { return Vec3(std::min(-kHalf - kRadius - 0.003 + kSpeed * t, kStop - kHalf - kRadius), 0, 0.02); });
  const auto away = [](double) { return PrescribedFinger::State{Vec3(0, 1, 1), Vec3::Zero()}; };
  Bench bench(cubesXml({0, kStop + 0.045}, true), {flick, away});
  double before = 0, after = 0;
  std::size_t most = 0;
  bench.eye->look = [&](const Tick&) {
    most = std::max(most, bench.eye->held->bodies.size());
    const double v = bench.cube(2).v_WB.x();
    if (v < 0.01 && after < 0.01) before = bench.cube(1).v_WB.x();
    after = std::max(after, v);
  };
  test::GuardedSteps steps(*bench.session);
  steps.run(400);
  EXPECT_EQ(steps.violation(RateGroup::kHaptic), "");
  EXPECT_EQ(most, 2U);
  EXPECT_GT(before, 0.3);
  EXPECT_NEAR(after, before / 2, 0.02);
}

// A cube that falls out of the fingers goes back to dynamics of 125 Hz, whose steps are 8 ms long and whose Euler steps
// fall faster than those of a tick. From tick to tick its velocity changes by gravity over such a step at most, and by
// the way back of some 0.3 mm within 50 ms.
TEST(HeldAtHapticRate, AFallingBodyIsGivenBackSmoothly) {
  constexpr double kStep = 0.008, kGravity = 9.81;
  std::string xml = cubesXml({0}, true);
  xml.insert(xml.find("<dynamics"), "<rates haptic=\"1000\" dynamics=\"125\"/>");
  Bench bench(xml, {lifting(-1), lifting(1)});
  std::vector<double> z;
  z.reserve(1000);
  std::size_t returning = 0;
  bench.eye->look = [&](const Tick& tick) {
    const auto& bodies = bench.eye->held->bodies;
    returning += bodies.size() == 1 && bodies[0].phase == ode::HeldBody::Phase::kGivenBack ? 1 : 0;
    if (tick.time > 1.26 && tick.time < 1.43) z.push_back(bench.eye->shown->poseAt(1, tick.time).p.z());
  };
  test::GuardedSteps steps(*bench.session);
  steps.run(1440);
  EXPECT_EQ(steps.violation(RateGroup::kHaptic), "");
  EXPECT_GT(returning, 40U);
  double worst = 0;
  for (std::size_t i = 2; i < z.size(); ++i) worst = std::max(worst, std::abs(z[i] - 2 * z[i - 1] + z[i - 2]));
  EXPECT_LT(worst, 1.3 * kGravity * kStep * kTick);
  EXPECT_LT(z.back(), z.front() - 0.15);
}

/// A finger beside the first of some cubes pushes it along x at 50 mm/s; the other one stays away.
std::vector<PrescribedFinger::Path> pushing() {
  return {[](double t) {
            const double x = -kHalf - kRadius - 0.003 + 0.05 * t;
            return PrescribedFinger::State{Vec3(x, 0, 0.02), Vec3(0.05, 0, 0)};
          },
          [](double) {
            return PrescribedFinger::State{Vec3(0, 1, 1), Vec3::Zero()};
          }};
}

struct Pushed {
  std::uint64_t taken = 0, too_many = 0;
  std::size_t most = 0;       // held at once
  double force_step = 0;      // of the finger, in a tick [N]
  double pose_step = 0;       // beyond the way at the velocity shown, of any cube in a tick [m]
  std::vector<double> end_x;  // [m]
};

Pushed push(const std::vector<double>& at, int max_held, double seconds) {
  Bench bench(cubesXml(at, true, max_held), pushing());
  Pushed pushed;
  std::vector<Vec3> last(at.size());
  Vec3 force = Vec3::Zero();
  bench.eye->look = [&](const Tick& tick) {
    const auto& held = bench.eye->held->bodies;
    pushed.most = std::max(pushed.most, static_cast<std::size_t>(std::count_if(held.begin(), held.end(), [](auto& one) {
                             return one.phase == ode::HeldBody::Phase::kHeld;
                           })));
    for (std::size_t i = 0; i < at.size(); ++i) {
      const Vec3 p = bench.eye->shown->poseAt(static_cast<std::int32_t>(i + 1), tick.time).p;
      if (tick.index > 10) pushed.pose_step = std::max(pushed.pose_step, (p - last[i]).norm());
      last[i] = p;
    }
    const Vec3& f = bench.eye->contact->fingers[0].f_H_W;
    pushed.force_step = std::max(pushed.force_step, (f - force).norm());
    force = f;
  };
  test::GuardedSteps steps(*bench.session);
  steps.run(static_cast<std::uint64_t>(1000 * seconds));
  EXPECT_EQ(steps.violation(RateGroup::kHaptic), "");
  EXPECT_EQ(bench.eye->shown->faults, 0U);
  pushed.taken = bench.eye->held->taken;
  pushed.too_many = bench.eye->held->too_many;
  for (const Vec3& p : last) pushed.end_x.push_back(p.x());
  return pushed;
}

// Three cubes in contact are taken over together when a finger touches the first; of four none is.
TEST(HeldAtHapticRate, AnIslandIsTakenAsAWholeOrNotAtAll) {
  const Pushed three = push({0, 0.04, 0.08}, 3, 1);
  EXPECT_EQ(three.taken, 3U);
  EXPECT_EQ(three.too_many, 0U);
  EXPECT_EQ(three.most, 3U);
  const Pushed four = push({0, 0.04, 0.08, 0.12}, 3, 1);
  EXPECT_EQ(four.taken, 0U);
  EXPECT_GE(four.too_many, 1U);
  EXPECT_EQ(four.most, 0U);
  // both rows have gone the way of the fingertip, less the depth of its spring
  EXPECT_NEAR(three.end_x[0], 0.047, 0.002);
  EXPECT_NEAR(four.end_x[0], 0.047, 0.002);
}

// Cubes 10 mm apart join the group one by one. The fourth one is too many: the group goes back, and no force or pose jumps
// by more than the impact of one cube on another explains: 0.05 m/s, and k times the way of the finger in a tick.
TEST(HeldAtHapticRate, AGroupThatGrowsTooLargeGoesBackAsAWhole) {
  const Pushed pushed = push({0, 0.05, 0.1, 0.15}, 3, 1);
  EXPECT_EQ(pushed.most, 3U);
  EXPECT_GE(pushed.too_many, 1U);
  EXPECT_LT(pushed.pose_step, 2 * 0.05 * kTick);
  EXPECT_LT(pushed.force_step, 2 * 2000 * 0.05 * kTick + 0.05);
  EXPECT_NEAR(pushed.end_x[0], 0.047, 0.002);
  for (std::size_t i = 1; i < 4; ++i) EXPECT_GT(pushed.end_x[i] - pushed.end_x[i - 1], 0.0399) << i;
}

// Against the clock, on three threads: for the thread sanitizer, and for what the two worlds of ODE share.
TEST(HeldAtHapticRate, TwoWorldsStepBesideEachOther) {
  Diagnostics diagnostics;
  RunOptions options;
  options.realtime = true;
  options.duration = 3;
  options.bus = BusSettings{.network = "none"};
  Loaded loaded =
      loadWorld({std::string(PRESA_SOURCE_DIR) + "/config/scenes/tea_tray.xml", "", {}}, options, diagnostics);
  ASSERT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
  RunControl control;
  presa::Run run(std::move(loaded), control, {});
  run.execute();
  EXPECT_EQ(run.monitor().objectFaults(), 0U);
  for (const FingerSummary& finger : run.monitor().fingers()) EXPECT_GT(finger.max_normal_force, 1);
}

/// The plan of a shipped scene.
Plan planOf(const std::string& coupling) {
  Diagnostics diagnostics;
  const Loaded loaded =
      loadWorld({std::string(PRESA_SOURCE_DIR) + "/config/scenes/cube.xml", "", {"dynamics/coupling=" + coupling}}, {},
                diagnostics);
  EXPECT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
  return loaded.plan;
}

TEST(HeldAtHapticRate, ItsModuleIsInTheGraphOnlyWhereNamed) {
  EXPECT_TRUE(planOf("haptic_rate").has("haptic_rate"));
  EXPECT_FALSE(planOf("soft").has("haptic_rate"));
  EXPECT_FALSE(planOf("averaged").has("haptic_rate"));
}

// The whole script of a scene in which the haptic thread moves four bodies: no tick allocates.
TEST(HeldAtHapticRate, NoTickOfTheTrayAllocates) {
  Diagnostics diagnostics;
  Loaded loaded = loadWorld({std::string(PRESA_SOURCE_DIR) + "/config/scenes/tea_tray.xml", "", {}}, {}, diagnostics);
  ASSERT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
  RunControl control;
  Session session(std::move(loaded), control, {});
  test::GuardedSteps steps(session);
  steps.run(9700);
  for (const RateGroup group : {RateGroup::kHaptic, RateGroup::kDynamics})
    EXPECT_EQ(steps.violation(group), "") << toString(group);
}

BodyMotion motionAt(const Vec3& p, double turn, const Vec3& v_WB, const Vec3& w_WB) {
  BodyMotion motion;
  motion.X_WB_end = {p, Quat(Eigen::AngleAxisd(turn, Vec3::UnitZ()))};
  motion.v_WB = v_WB;
  motion.w_WB = w_WB;
  return motion;
}

// It begins at one motion, ends at the other, and its velocities are the derivatives of its poses.
TEST(GentleReturn, LeadsFromOneMotionToTheOther) {
  const BodyMotion from = motionAt({1e-3, 0, 2e-3}, 0.02, {0.1, 0, 0}, {0, 0, 0.5});
  const BodyMotion to = motionAt({0, 1e-3, 0}, 0, {0, 0.05, 0}, {0, 0, 0});
  const ode::GentleReturn way(from, to, 2);
  const BodyMotion begin = way.at(to, 2), end = way.at(to, 2 + ode::GentleReturn::kTime);
  EXPECT_LT((begin.X_WB_end.p - from.X_WB_end.p).norm(), 1e-15);
  EXPECT_LT(begin.X_WB_end.q.angularDistance(from.X_WB_end.q), 1e-12);
  EXPECT_LT((begin.v_WB - from.v_WB).norm() + (begin.w_WB - from.w_WB).norm(), 1e-12);
  EXPECT_LT((end.X_WB_end.p - to.X_WB_end.p).norm() + (end.v_WB - to.v_WB).norm(), 1e-14);
  EXPECT_TRUE(way.isOver(2 + ode::GentleReturn::kTime + 1e-9));
  constexpr double kStep = 1e-7;
  for (double t = 2.005; t < 2.05; t += 0.005) {
    const BodyMotion a = way.at(to, t - kStep), b = way.at(to, t + kStep);
    const Vec3 rate = (b.X_WB_end.p - a.X_WB_end.p) / (2 * kStep);
    EXPECT_LT((rate - (way.at(to, t).v_WB - to.v_WB)).norm(), 1e-6) << t;
  }
}

}  // namespace
}  // namespace presa::held
