#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "devices/hand/finger_plant.h"
#include "devices/hand/motion.h"

namespace presa {
namespace {

std::string writeFile(const std::string& name, const std::string& text) {
  const auto path = std::filesystem::temp_directory_path() / ("presa_motion_" + name);
  std::ofstream(path) << text;
  return path.string();
}

// Oracle: the closed form of m x'' + b x' + k x = F from rest, under-damped. The plant is exact, so only rounding
// remains.
TEST(FingerPlant, FollowsTheClosedFormOfADampedOscillator) {
  const FingerImpedance impedance{.mass = 0.1, .stiffness = 300, .damping = 2};
  for (const double period : {1e-3, 0.25e-3, 5e-3}) {
    FingerPlant plant(impedance, period);
    const double force = 1.5;
    const double a = impedance.damping / (2 * impedance.mass);
    const double w = std::sqrt(impedance.stiffness / impedance.mass - a * a);
    double t = 0;
    while (t < 0.5) {
      plant.step(Vec3::Zero(), Vec3::Zero(), {force, 0, 0});
      t += period;
      const double x =
          force / impedance.stiffness * (1 - std::exp(-a * t) * (std::cos(w * t) + a / w * std::sin(w * t)));
      ASSERT_NEAR(plant.position().x(), x, 1e-12);
    }
  }
}

// Against a wall of stiffness K the sampled finger is stable below K = 2 b / T and grows above it [Colgate1997]:
// the loop has no hidden delay (one sample would cut the bound to a third). Within 2 % as in the oracle table for
// m = 0.1 kg: K_max = 2003.3 N/m at b = 1 N s/m.
TEST(FingerPlant, HasTheStabilityBoundOfALoopWithoutDelay) {
  const auto grows = [](double stiffness) {
    FingerPlant plant({.mass = 0.1, .stiffness = 1e-9, .damping = 1}, 1e-3);
    plant.reset({1e-3, 0, 0});
    double early = 0, late = 0;
    for (int i = 0; i < 4000; ++i) {
      plant.step(plant.position(), Vec3::Zero(), -stiffness * plant.position());
      const double size = std::abs(plant.position().x());
      (i < 2000 ? early : late) = std::max(i < 2000 ? early : late, size);
    }
    return late > early;
  };
  EXPECT_FALSE(grows(0.98 * 2003.3));
  EXPECT_TRUE(grows(1.02 * 2003.3));
}

// "auto" damping never lies below twice the wall bound, and never below 0.7 of critical.
TEST(FingerPlant, AutomaticDampingRespectsTheBounds) {
  const FingerImpedance impedance{.mass = 0.1, .stiffness = 300};
  EXPECT_GE(automaticDamping(impedance, 10'000, 1e-3, 5e-3), 10);
  EXPECT_GE(automaticDamping(impedance, 10'000, 1e-3, 5e-3),
            1.5 * heldObjectDampingBound(impedance, 10'000, 1e-3, 5e-3));
  EXPECT_NEAR(automaticDamping(impedance, 500, 1e-3, 5e-3), 1.4 * std::sqrt(30), 1e-12);
}

// The bound for a held massless object, against a simulation of the same loop without its eigenvalues: below it
// (0.95) a small push grows, above it (1.05) it dies.
TEST(FingerPlant, HeldObjectBoundIsWhereAPushStopsGrowing) {
  const double stiffness = 10'000;
  const FingerImpedance impedance{.mass = 0.1, .stiffness = 300};
  const double bound = heldObjectDampingBound(impedance, stiffness, 1e-3, 5e-3);
  for (const double factor : {0.95, 1.05}) {
    FingerPlant plant({.mass = 0.1, .stiffness = 300, .damping = factor * bound}, 1e-3);
    plant.reset({1e-6, 0, 0});
    double from = 0, to = 0, sample_x = 0, sample_v = 0, early = 0, late = 0;
    for (int i = 0; i < 12'000; ++i) {
      if (i % 5 == 0) {
        from = to;
        to = sample_x + 6e-3 * sample_v;
      }
      sample_x = plant.position().x(), sample_v = plant.velocity().x();
      plant.step(Vec3::Zero(), Vec3::Zero(), {stiffness * (from + (to - from) * (i % 5) / 5 - sample_x), 0, 0});
      // the first seconds belong to the modes that die out
      double& window = i < 8000 ? early : late;
      if (i >= 4000) window = std::max(window, std::abs(plant.position().x()));
    }
    EXPECT_EQ(late > early, factor < 1) << bound;
  }
}

// A soft contact settles whatever the damping: the bisection ends at zero (it went on to the smallest number that a
// double can hold, 30 ms of each load).
TEST(FingerPlant, HeldObjectBoundIsZeroWhereNoDampingIsNeeded) {
  const FingerImpedance impedance{.mass = 0.1, .stiffness = 300};
  EXPECT_EQ(heldObjectDampingBound(impedance, 50, 1e-3, 5e-3), 0);
}

constexpr const char* kPinch = R"(<motion version="1.0" name="pinch">
  <finger mass="0.1" stiffness="300" damping="auto"/>
  <grasp point="0 0 0.04" axis="1 0 0" width="0.07" open="0.03"/>
  <phase name="reach" duration="1" open="0"/>
  <phase name="squeeze" duration="0.5" grip="6"/>
  <phase name="up" intent="lift" duration="1" move="0 0 0.1"/>
  <phase name="loosen" intent="release" duration="1" grip="0" open="0.02"/>
</motion>)";

// Thumb and index mirror each other; at the end of the reach each fingertip's surface is on the object's.
TEST(PhasedMotion, ReachesTheFacesFromBothSides) {
  const std::string file = writeFile("pinch.xml", kPinch);
  Diagnostics diagnostics;
  const auto thumb = readPhasedMotion(file, {"thumb", -1, 0.008}, diagnostics);
  const auto index = readPhasedMotion(file, {"index", 1, 0.008}, diagnostics);
  ASSERT_TRUE(thumb && index) << diagnostics.text();
  EXPECT_NEAR(index->at(0).p_WT.x(), 0.035 + 0.008 + 0.03, 1e-12);
  EXPECT_NEAR(index->at(1.0).p_WT.x(), 0.035 + 0.008, 1e-12);
  for (double t = 0; t < 4; t += 0.1) {
    const MotionTarget a = thumb->at(t), b = index->at(t);
    EXPECT_NEAR(a.p_WT.x(), -b.p_WT.x(), 1e-12);
    EXPECT_NEAR(a.p_WT.z(), b.p_WT.z(), 1e-12);
  }
  EXPECT_NEAR(index->at(1.25).grip, 3, 1e-12);  // straight ramp
  EXPECT_EQ(index->at(1.25).inward_W, Vec3(-1, 0, 0));
  EXPECT_NEAR(index->at(2.5).p_WT.z(), 0.14, 1e-12);
  EXPECT_EQ(index->phase_names, (std::vector<std::string>{"reach", "squeeze", "up", "loosen"}));
  using enum PhaseIntent;
  EXPECT_EQ(index->phase_intents, (std::vector{kNone, kNone, kLift, kRelease}));
  EXPECT_EQ(index->at(99).phase, 3);
}

// The stated velocity is the derivative of the stated position (central differences of step 1e-6).
TEST(PhasedMotion, VelocityIsTheDerivativeOfPosition) {
  Diagnostics diagnostics;
  const auto motion = readPhasedMotion(writeFile("pinch2.xml", kPinch), {"index", 1, 0.008}, diagnostics);
  ASSERT_TRUE(motion);
  for (double t = 0.013; t < 3.4; t += 0.05) {
    const Vec3 slope = (motion->at(t + 1e-6).p_WT - motion->at(t - 1e-6).p_WT) / 2e-6;
    EXPECT_NEAR((slope - motion->at(t).v_WT).norm(), 0, 1e-6) << t;
  }
}

TEST(KeyframeMotion, PassesThroughItsKeyframes) {
  const std::string file = writeFile("keys.csv",
                                     "# two fingers\ntime_s,role,x_m,y_m,z_m,fx_N,fy_N,fz_N,phase\n"
                                     "0,thumb,-0.1,0,0.05,0,0,0,reach\n1,thumb,-0.04,0,0.05,2,0,0,hold\n"
                                     "0,index,0.1,0,0.05,0,0,0,reach\n2,thumb,-0.04,0,0.15,2,0,0,hold\n");
  Diagnostics diagnostics;
  const auto motion = readKeyframeMotion(file, {"thumb", -1, 0.008}, diagnostics);
  ASSERT_TRUE(motion) << diagnostics.text();
  EXPECT_EQ(motion->at(0).p_WT, Vec3(-0.1, 0, 0.05));
  EXPECT_NEAR((motion->at(1).p_WT - Vec3(-0.04, 0, 0.05)).norm(), 0, 1e-15);
  EXPECT_NEAR(motion->at(1.5).p_WT.z(), 0.1, 1e-12);
  EXPECT_NEAR(motion->at(0.5).force_W.x(), 1, 1e-12);
  EXPECT_EQ(motion->at(5).p_WT, Vec3(-0.04, 0, 0.15));
  EXPECT_EQ(motion->phase_names, (std::vector<std::string>{"reach", "hold"}));
}

// Intents of keyframes are a column beside the phases'; another word is refused where it stands.
TEST(KeyframeMotion, ReadsIntents) {
  const std::string head = "time_s,role,x_m,y_m,z_m,phase,intent\n0,thumb,0,0,0,down,\n";
  Diagnostics diagnostics;
  const auto motion =
      readKeyframeMotion(writeFile("intents.csv", head + "1,thumb,0,0,0,press,hold\n2,thumb,0,0,0,off,release\n"),
                         {"thumb", -1, 0.008}, diagnostics);
  ASSERT_TRUE(motion) << diagnostics.text();
  using enum PhaseIntent;
  EXPECT_EQ(motion->phase_intents, (std::vector{kNone, kHold, kRelease}));
  const std::string file = writeFile("word.csv", head + "1,thumb,0,0,0,press,hodl\n");
  readKeyframeMotion(file, {"thumb", -1, 0.008}, diagnostics);
  EXPECT_NE(diagnostics.text().find(file + ":3:21: error[E429]: 'hodl' is not an intent"), std::string::npos)
      << diagnostics.text();
  Diagnostics without;
  readKeyframeMotion(writeFile("none.csv", "time_s,role,x_m,y_m,z_m,intent\n0,thumb,0,0,0,hold\n"),
                     {"thumb", -1, 0.008}, without);
  EXPECT_NE(without.text().find("error[E422]: column 'phase' is missing"), std::string::npos) << without.text();
}

// Phases in a row that have one intent are one span; the first such span counts.
TEST(PhaseIntent, SpansTheFirstPhasesInARow) {
  using enum PhaseIntent;
  const std::vector<double> times{0, 1, 3, 4, 6, 7};
  const auto span = firstSpanOf(kHold, {kNone, kHold, kHold, kRelease, kHold}, times);
  ASSERT_TRUE(span);
  EXPECT_EQ(span->begin, 1);
  EXPECT_EQ(span->end, 4);
  EXPECT_FALSE(firstSpanOf(kLift, {kNone, kHold, kHold, kRelease, kHold}, times));
  EXPECT_FALSE(firstSpanOf(kHold, {}, times));
}

// Orientations: at the keyframes, the shorter way between them (q and -q are one), at the rate that is the derivative.
TEST(KeyframeMotion, TurnsAToolTheShorterWay) {
  Diagnostics diagnostics;
  const auto motion = readKeyframeMotion(writeFile("turn.csv",
                                                   "time_s,role,x_m,y_m,z_m,qw,qx,qy,qz\n0,pen,0,0,0,1,0,0,0\n"
                                                   "2,pen,0,0,0,-0.8660254037844386,-0.5,0,0\n"),
                                         {"pen", 1, 0}, diagnostics);
  ASSERT_TRUE(motion) << diagnostics.text();
  EXPECT_TRUE(motion->oriented);
  EXPECT_NEAR(motion->at(1).q_WT.angularDistance(Quat::Identity()), std::acos(-1.0) / 6, 1e-12);  // half of 60 degrees
  for (double t = 0.1; t < 2; t += 0.1) {
    const Quat before = motion->at(t - 1e-6).q_WT, after = motion->at(t + 1e-6).q_WT;
    EXPECT_NEAR((after * before.conjugate()).x() * 2 / 2e-6, motion->at(t).w_WT.x(), 1e-6) << t;
  }
  EXPECT_EQ(readKeyframeMotion(writeFile("long.csv", "time_s,role,x_m,y_m,z_m,qw,qx,qy,qz\n0,pen,0,0,0,1,1,0,0\n"),
                               {"pen", 1, 0}, diagnostics),
            nullptr);
  EXPECT_NE(diagnostics.text().find("error[E427]"), std::string::npos) << diagnostics.text();
}

// Every error is reported with its line and column, all of them at once.
TEST(KeyframeMotion, NamesEveryMistakeWithItsPlace) {
  const std::string file =
      writeFile("bad.csv",
                "time_s,role,x_m,y_m,z_m\n0,thumb,0,0,0\n1,thumb,zero,0,nan\n0.5,thumb,0,0\n1,thumb,0,0,0\n"
                "1,thumb,0,0,0\n");
  Diagnostics diagnostics;
  EXPECT_EQ(readKeyframeMotion(file, {"thumb", -1, 0.008}, diagnostics), nullptr);
  ASSERT_EQ(diagnostics.errorCount(), 5u) << diagnostics.text();
  EXPECT_EQ(diagnostics.all()[0].code, 426);
  EXPECT_EQ(diagnostics.all()[0].where.line, 3);
  EXPECT_EQ(diagnostics.all()[0].where.column, 9);
  EXPECT_EQ(diagnostics.all()[2].code, 423);
  Diagnostics header;
  EXPECT_EQ(readKeyframeMotion(writeFile("head.csv", "time,role,x_m,y_m,z_m\n"), {"thumb", -1, 0.008}, header),
            nullptr);
  EXPECT_NE(header.text().find("did you mean 'time_s'"), std::string::npos) << header.text();
}

}  // namespace
}  // namespace presa
