// The ring of bodies that hit each other, against its formula; the shipped scene, with both couplings; bad elements.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

#include "tests/apps/support/support.h"
#include "tests/support/alloc_lock_guard.h"
#include "tests/support/lockstep_run.h"
#include "tests/support/rendered_body.h"

namespace presa {
namespace {

constexpr double kPeriod = 1e-3, kRest = 0.0565;  // of the fingertip's centre, 1.5 mm deep in the box [m]
constexpr double kFrequency = 120, kDecay = 0.02, kGain = 3, kLargest = 1.2;
constexpr double kW = 2 * std::numbers::pi * kFrequency;

test::RenderedBody box(const std::string& b = "any") {
  return {R"(<haptics renderer="god_object"/><knock a="any" b=")" + b +
              R"(" frequency="120" decay="0.02" gain="3" max_force="1.2"/>)",
          R"(<box size="0.1 0.1 0.1"/>)"};
}

BodyHit hitAt(double time, double speed, std::int32_t A = 0, std::int32_t B = 0) {
  return {.time = time, .A = A, .B = B, .speed = speed};
}

double formula(double speed, double t) { return t < 0 ? 0 : kGain * speed * std::exp(-t / kDecay) * std::sin(kW * t); }

/// Force of a fingertip at rest over the spring's own, in 200 ticks.
std::vector<double> ringOf(test::RenderedBody& body) {
  std::vector<double> ring;
  for (int i = 0; i < 200; ++i) ring.push_back(body.force({0, 0, kRest}).z() - 1.5);
  return ring;
}

void arrive(test::RenderedBody& body) {
  body.force({0, 0, 0.06});
  body.force({0, 0, kRest});
}

// The hits are ahead of the haptic thread, or a part of a tick behind it; their rings add up.
TEST(Knock, RingsAsItsFormulaSays) {
  test::RenderedBody body = box();
  arrive(body);
  double time = 2 * kPeriod;
  body.hear(hitAt(time + 0.0042, 0.2));
  body.hear(hitAt(time + 0.0513, 0.1));
  for (const double f : ringOf(body)) {
    time += kPeriod;
    EXPECT_NEAR(f, formula(0.2, time - 2 * kPeriod - 0.0042) + formula(0.1, time - 2 * kPeriod - 0.0513), 1e-9) << time;
  }
}

TEST(Knock, RingsNoLouderThanItsBound) {
  test::RenderedBody body = box();
  arrive(body);
  double largest = 0;
  for (int i = 0; i < 10; ++i) body.hear(hitAt(0.003 + 0.04 * i, 5));
  for (const double f : ringOf(body)) largest = std::max(largest, std::abs(f));
  EXPECT_LE(largest, kLargest);
  EXPECT_GT(largest, 0.8 * kLargest);
}

TEST(Knock, OfBeforeAFingertipArrivedIsNotFelt) {
  test::RenderedBody body = box();
  body.hear(hitAt(0, 1));
  arrive(body);
  for (const double f : ringOf(body)) EXPECT_NEAR(f, 0, 1e-9);
}

TEST(Knock, NeitherAllocatesNorLocks) {
  test::RenderedBody body = box();
  arrive(body);
  RealTimeGuard guard;
  for (int i = 0; i < 60; ++i) {
    body.hear(hitAt(0.003 + 0.04 * i, 0.5));
    body.force({0, 0, kRest});
  }
  EXPECT_EQ(guard.violations(), 0) << guard.first();
}

// A hit of the other pair, of bodies that this one is not, and of the right pair: only the last is felt.
TEST(Knock, RingsForItsPairOfMaterials) {
  for (const auto& [b, hit, felt] :
       {std::tuple("other", hitAt(0.003, 0.2, 0, 0), false), std::tuple("any", hitAt(0.003, 0.2, 0, 1), false),
        std::tuple("other", hitAt(0.003, 0.2, 1, 1), false), std::tuple("other", hitAt(0.003, 0.2, 0, 1), true),
        std::tuple("other", hitAt(0.003, 0.2, 1, 0), true)}) {
    test::RenderedBody body = box(b);
    arrive(body);
    body.hear(hit);
    double largest = 0;
    for (const double f : ringOf(body)) largest = std::max(largest, std::abs(f));
    EXPECT_EQ(largest > 0.3, felt) << b << ' ' << hit.A << ' ' << hit.B;
    if (!felt) {
      EXPECT_LT(largest, 1e-9);
    }
  }
}

/// The finding for a scene with these elements.
std::string refusalOf(const std::string& elements) {
  try {
    test::RenderedBody(elements, R"(<box size="0.1 0.1 0.1"/>)");
  } catch (const InputError& error) {
    return error.diagnostics().text();
  }
  return {};
}

TEST(Knock, OfNoMaterialOrOfOnePairTwiceIsRefused) {
  const std::string ring = R"( frequency="120" decay="0.02" gain="3"/>)";
  const std::string chalk = refusalOf(R"(<knock a="any" b="chalk")" + ring);
  EXPECT_NE(chalk.find("<knock> has b 'chalk', which does not exist"), std::string::npos) << chalk;
  EXPECT_NE(chalk.find("materials: any, other"), std::string::npos) << chalk;
  const std::string twice = refusalOf(R"(<knock a="any" b="other")" + ring + R"(<knock a="other" b="any")" + ring);
  EXPECT_NE(twice.find("error[E596]"), std::string::npos) << twice;
  EXPECT_NE(twice.find("the scene has 2 <knock> of 'any' and 'other'; one is allowed"), std::string::npos) << twice;
}

// Each of the two pairs is felt, whichever thread moves the cube; the cube moves as without the rings.
TEST(SceneWithKnocks, RingsOnStoneAndOnCork) {
  const std::string scene = test::source("config/scenes/knocks.xml");
  for (const std::string coupling : {"soft", "haptic_rate"}) {
    const std::string set = "dynamics/coupling=" + coupling;
    const test::LockstepRun faint(scene, {set, "knock[1]/gain=0.1", "knock[2]/gain=0.1"});
    for (const std::string weak : {"knock[1]/gain=0.1", "knock[2]/gain=0.1"}) {
      const test::LockstepRun run(scene, {set, weak});
      EXPECT_TRUE(run.faults().empty()) << run.faults().front();
      EXPECT_GT(run.maxNormalForce("index"), faint.maxNormalForce("index") + 0.5) << coupling << weak;
      EXPECT_NEAR(run.rise("cube"), faint.rise("cube"), 0.003) << coupling;
    }
  }
}

TEST(SceneWithKnocks, SaysWhatItLoadsAndWhichEngineCannot) {
  const std::string scene = test::source("config/scenes/knocks.xml");
  const test::Outcome explained = test::presa("explain " + scene);
  EXPECT_NE(explained.out.find("knock: steel on stone rings at 220 Hz"), std::string::npos) << explained.out;
  EXPECT_NE(explained.out.find("presa_knock.so"), std::string::npos) << explained.out;
  EXPECT_NE(explained.out.find("note the bodies that hit each other"), std::string::npos) << explained.out;
  const test::Outcome without = test::presa("explain " + test::source("config/scenes/cube.xml"));
  EXPECT_EQ(without.out.find("note the bodies that hit"), std::string::npos) << without.out;
  const test::Outcome bullet =
      test::presa("run " + scene + " --lockstep --set dynamics/coupling=soft --set dynamics/engine=bullet");
  EXPECT_EQ(bullet.status, 2);
  EXPECT_NE(bullet.err.find("error[E265]"), std::string::npos) << bullet.err;
  EXPECT_NE(bullet.err.find("engines that do: ode"), std::string::npos) << bullet.err;
}

}  // namespace
}  // namespace presa
