#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/device/output_limits.h"
#include "framework/scene/load.h"

namespace presa {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const DeviceRating kArm{.force = 10, .continuous = 4, .heating_time = 60, .speed = 1};

OutputLimits limits(const DeviceBinding::Limits& allowed, const DeviceRating& rating, std::vector<std::string>& notes) {
  DeviceRole role;
  role.role = "thumb";
  return limitsFor(role, allowed, rating, notes);
}

// Nothing said, a rating known: half of the nominal force, 1 N/ms, half a second, the device's own heat and speed.
TEST(OutputLimits, WithoutAWordTheyAreSafe) {
  std::vector<std::string> notes;
  const OutputLimits found = limits({}, kArm, notes);
  EXPECT_EQ(found.force, 5);
  EXPECT_EQ(found.force_rate, 1000);
  EXPECT_EQ(found.soft_start, 0.5);
  EXPECT_EQ(found.continuous, 4);
  EXPECT_EQ(found.speed, 1);
  EXPECT_FALSE(found.records_overload);
  EXPECT_FALSE(found.passivity);
  EXPECT_THAT(notes, ElementsAre(HasSubstr(
                         "thumb: forces up to 5 N (the scene asks for 8, the device's nominal force is 10 N): half")));
}

TEST(OutputLimits, TheRigRaisesThemUpToTheRatingAndNoFurther) {
  std::vector<std::string> notes;
  DeviceBinding::Limits allowed;
  allowed.force = 50;
  allowed.force_rate = 5000;
  allowed.continuous = 6;
  const OutputLimits found = limits(allowed, kArm, notes);
  EXPECT_EQ(found.force, 8);          // what the scene wants
  EXPECT_EQ(found.force_rate, 1000);  // likewise
  EXPECT_EQ(found.continuous, 4);     // what the motors bear
}

// 8 N at 1 N/ms are not down within 5 ms: said before anybody finds out.
TEST(OutputLimits, ASlowWayDownIsSaid) {
  std::vector<std::string> notes;
  DeviceBinding::Limits allowed;
  allowed.force = 8;
  limits(allowed, kArm, notes);
  EXPECT_THAT(notes, ElementsAre(HasSubstr("from 8 N to zero takes 8.0 ms")));
}

TEST(OutputLimits, SimulatedFingersHaveWhatTheSceneWants) {
  std::vector<std::string> notes;
  const OutputLimits found = limits({}, {}, notes);
  EXPECT_EQ(found.force, 8);
  EXPECT_THAT(notes, IsEmpty());
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
