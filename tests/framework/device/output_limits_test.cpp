#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "framework/device/output_limits.h"
#include "framework/scene/load.h"

namespace presa {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr DeviceRating kArm{
    .force = 10, .force_rate = 1000, .continuous = 4, .speed = 1, .behind = DeviceRating::Behind::kModel};

class Limits : public testing::Test {
 protected:
  Limits() {
    role.role = "thumb";
    role.where = {"scene.xml", 12, 5};
    bound.where = {"rig.xml", 3, 7};
  }
  OutputLimits limits(const DeviceRating& rating = kArm) { return safety(rating).limits; }
  FingerSafety safety(const DeviceRating& rating = kArm) {
    notes.clear();
    findings = {};
    return safetyFor(role, bound, rating, notes, findings);
  }
  DeviceRole role;
  DeviceBinding bound;
  std::vector<std::string> notes;
  Diagnostics findings;
};

// A rig without limits: half of the nominal force, 1 N/ms, half a second, the rating's heat and speed.
TEST_F(Limits, WithoutAWordTheyAreSafe) {
  const OutputLimits found = limits();
  EXPECT_EQ(found.force, 5);
  EXPECT_EQ(found.force_rate, 1000);
  EXPECT_EQ(found.soft_start, 0.5);
  EXPECT_EQ(found.continuous, 4);
  EXPECT_EQ(found.speed, 1);
  EXPECT_FALSE(found.records_overload);
  EXPECT_FALSE(found.passivity);
  EXPECT_EQ(safety().watchdog, 0.02);
  EXPECT_THAT(notes, ElementsAre(HasSubstr(
                         "thumb: forces up to 5 N (the scene asks for 8, the device's nominal force is 10 N): half")));
  EXPECT_EQ(findings.text(), "");
}

// The scene asks for more than the rig allows, and the rig allows more than the device bears: the device's rating it
// is, in each of them, and each is said, with the place where it was asked for.
TEST_F(Limits, TheRigRaisesThemUpToTheRatingAndNoFurther) {
  role.limits = {.force = 1e9, .force_rate = 1e9, .watchdog_ms = 1e9};
  bound.limits.force = 50;
  bound.limits.force_rate = 5000;
  bound.limits.continuous = 6;
  bound.limits.speed = 1000;
  const FingerSafety found = safety();
  EXPECT_EQ(found.limits.force, 10);
  EXPECT_EQ(found.limits.force_rate, 1000);
  EXPECT_EQ(found.limits.continuous, 4);
  EXPECT_EQ(found.limits.speed, 1);
  EXPECT_EQ(found.watchdog, 0.1);
  const std::string rig = "rig.xml:3:7: warning[W651]: role 'thumb': the rig allows ";
  EXPECT_THAT(findings.text(), HasSubstr(rig + "force=\"50\", the device is rated for 10 N; the rating is used"));
  EXPECT_THAT(findings.text(),
              HasSubstr(rig + "force_rate=\"5000\", the device is rated for 1000 N/s; the rating is used"));
  EXPECT_THAT(findings.text(), HasSubstr(rig + "continuous=\"6\", the device is rated for 4 N; the rating is used"));
  EXPECT_THAT(findings.text(), HasSubstr(rig + "speed=\"1000\", the device is rated for 1 m/s; the rating is used"));
  EXPECT_THAT(
      findings.text(),
      HasSubstr("scene.xml:12:5: warning[W650]: role 'thumb': force_rate is 1e+09 N/s, the device is rated for"));
  EXPECT_THAT(
      findings.text(),
      HasSubstr("scene.xml:12:5: warning[W653]: role 'thumb': watchdog_ms is 1e+09, the device is rated for 100"));
  EXPECT_EQ(findings.all().size(), 6U);
}

// Each limit of the rig that tightens the rating holds.
TEST_F(Limits, TheRigTightensEachOfThem) {
  bound.limits.force = 2;
  bound.limits.force_rate = 600;
  bound.limits.soft_start = 3;
  bound.limits.continuous = 1;
  bound.limits.speed = 0.25;
  const OutputLimits found = limits();
  EXPECT_EQ(found.force, 2);
  EXPECT_EQ(found.force_rate, 600);
  EXPECT_EQ(found.soft_start, 3);
  EXPECT_EQ(found.continuous, 1);
  EXPECT_EQ(found.speed, 0.25);
  EXPECT_EQ(findings.text(), "");
  EXPECT_THAT(notes, ElementsAre(HasSubstr("forces up to 2 N"),
                                 HasSubstr("the force changes by up to 600 N/s (the scene asks for 1000")));
}

// So does each limit of the scene.
TEST_F(Limits, TheSceneTightensWhatTheRigLeaves) {
  role.limits = {.force = 1, .force_rate = 300, .watchdog_ms = 15};
  bound.limits.force = 2;
  bound.limits.force_rate = 600;
  const FingerSafety found = safety();
  EXPECT_EQ(found.limits.force, 1);
  EXPECT_EQ(found.limits.force_rate, 300);
  EXPECT_EQ(found.watchdog, 0.015);
  EXPECT_EQ(findings.text(), "");
  EXPECT_THAT(notes, IsEmpty());
}

// A slew of 0.1 N/s would hold a hand for a minute. The warning names its source, scene or rig; 8 N in 12 ms are 667
// N/s.
TEST_F(Limits, TheWayDownIsNeverSlow) {
  bound.limits.force = 8;
  role.limits.force_rate = 0.1;
  EXPECT_DOUBLE_EQ(limits().force_rate, 8 / DeviceRating::kSlowestDecay);
  EXPECT_THAT(findings.text(), HasSubstr("scene.xml:12:5: warning[W652]: role 'thumb': force_rate 0.1 N/s takes 8 N to "
                                         "zero in 8e+04 ms, at most 12 ms are allowed"));
  role.limits.force_rate = 1000;
  bound.limits.force_rate = 0.1;
  EXPECT_DOUBLE_EQ(limits().force_rate, 8 / DeviceRating::kSlowestDecay);
  EXPECT_THAT(findings.text(), HasSubstr("rig.xml:3:7: warning[W652]"));
}

// Real motors are limited; a study may overload a model and record it.
TEST_F(Limits, OnlyAModelMayBeOverloaded) {
  bound.limits.records_overload = true;
  EXPECT_TRUE(limits().records_overload);
  EXPECT_EQ(findings.text(), "");
  DeviceRating motors = kArm;
  motors.behind = DeviceRating::Behind::kMotors;
  EXPECT_FALSE(limits(motors).records_overload);
  EXPECT_THAT(findings.text(), HasSubstr("rig.xml:3:7: warning[W654]"));
}

TEST(DeviceRatings, AreFiniteAndLeadToZeroInTime) {
  EXPECT_TRUE(isSound({}));
  EXPECT_TRUE(isSound({.force = 12, .force_rate = 1000}));
  EXPECT_FALSE(isSound({.force = 12.1, .force_rate = 1000}));  // 12.1 ms
  constexpr double kNever = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(isSound({.force = kNever, .force_rate = kNever}));
  EXPECT_FALSE(isSound({.force_rate = kNever}));
  EXPECT_FALSE(isSound({.speed = kNever}));
  EXPECT_FALSE(isSound({.watchdog = kNever}));
  EXPECT_FALSE(isSound({.force = std::numeric_limits<double>::quiet_NaN()}));
}

// 8 N at 1 N/ms are not zero within 5 ms: a note says so at the start.
TEST_F(Limits, ASlowWayDownIsSaid) {
  bound.limits.force = 8;
  limits();
  EXPECT_THAT(notes, ElementsAre(HasSubstr("from 8 N to zero takes 8.0 ms")));
}

TEST_F(Limits, ImaginedFingersHaveWhatTheSceneWants) {
  EXPECT_EQ(limits(kImaginedRating).force, 8);
  EXPECT_THAT(notes, IsEmpty());
  role.limits = {.force = 1e12, .force_rate = 1e12};
  EXPECT_EQ(limits(kImaginedRating).force, 1000);  // large but finite
  EXPECT_EQ(limits(kImaginedRating).force_rate, 1e6);
}

TEST(OutputLimits, StandInTheRig) {
  Diagnostics diagnostics;
  const Rig rig = parseRig(R"(<rig version="1.0" name="r"><device role="thumb" driver="percro_arm">
    <limits force="9" past_continuous="record" passivity="true"/></device></rig>)",
                           "rig.xml", "", diagnostics);
  ASSERT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
  EXPECT_EQ(rig.devices[0].limits.force, 9);
  EXPECT_FALSE(rig.devices[0].limits.continuous);
  EXPECT_TRUE(rig.devices[0].limits.records_overload);
  EXPECT_TRUE(rig.devices[0].limits.passivity);
}

// A soft start shorter than half a second is refused, with what is allowed.
TEST(OutputLimits, AHardStartIsRefused) {
  Diagnostics diagnostics;
  parseRig(
      R"(<rig version="1.0" name="r"><device role="thumb" driver="x"><limits soft_start="0.1" force="-1"/></device></rig>)",
      "rig.xml", "", diagnostics);
  EXPECT_THAT(diagnostics.text(), HasSubstr("at least 0.5"));
  EXPECT_EQ(diagnostics.errorCount(), 2U);
}

}  // namespace
}  // namespace presa
