// Each rule of the force watch, violated once and just kept once.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/devices/falcon_model/host.h"

namespace presa::falcon_model::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A push along z; a newton is about 220 counts per motor at rest.
Request push(int counts) { return {.counts = {-counts, -counts, -counts}}; }

struct Watched : testing::Test {
  FalconModel model{running()};
  Host host{model};
  void SetUp() override { host.toOperation(); }
  /// Lets the host read ten replies.
  void homed() { host.cycles({}, 12); }
};

TEST_F(Watched, QuietIsClean) {
  homed();
  EXPECT_THAT(model.violations(), IsEmpty());
}

TEST_F(Watched, ForceNeedsTenRepliesWithAllReferences) {
  // a reply is read one cycle after its request: the eleventh request is the first after ten replies
  host.cycles({}, 9);
  host.cycle(push(1));
  EXPECT_THAT(model.violations(), ElementsAre(HasSubstr("before all references")));
}
TEST_F(Watched, AfterTenForceMayCome) {
  host.cycles({}, 10);
  host.cycle(push(1));
  EXPECT_THAT(model.violations(), IsEmpty());
  EXPECT_GT(model.received().force_D.z(), 0);
}

TEST_F(Watched, WordsHaveALimit) {
  homed();
  host.cycle(push(4095));
  EXPECT_THAT(model.violations(), IsEmpty());
  host.cycle(push(4096));
  EXPECT_THAT(model.violations(), ElementsAre(HasSubstr("more counts")));
}

TEST_F(Watched, NewtonsHaveALimit) {
  homed();
  const double newton = -forceOf({1, 1, 1}, model.grip().rates()).z();  // of a count
  model.limits({.force = 100 * newton});
  host.cycle(push(100));
  EXPECT_THAT(model.violations(), IsEmpty());
  host.cycle(push(103));  // up to 101.5 is allowed: half a count per motor
  EXPECT_THAT(model.violations(), ElementsAre(HasSubstr("more force")));
}

TEST_F(Watched, ForceMayNotChangeFasterThanTheSlewLimit) {
  homed();
  const double newton = -forceOf({1, 1, 1}, model.grip().rates()).z();
  model.limits({.force_rate = 100 * newton / 1e-3});
  host.cycle(push(100));
  host.cycle(push(200));
  host.cycle(push(0));
  EXPECT_THAT(model.violations(), ElementsAre(HasSubstr("faster")));
  EXPECT_NEAR(model.watch().largestStep(), 200 * newton, 3 * newton);
}

TEST_F(Watched, ARequestThatComesEarlyMayChangeTheForceLess) {
  homed();
  const double newton = -forceOf({1, 1, 1}, model.grip().rates()).z();
  model.limits({.force_rate = 100 * newton / 1e-3});
  host.cycle(push(100));
  const Frame frame = frameOf(push(200));
  host.write({frame.begin(), frame.end()});
  host.readFor(0.5e-3);
  const Frame next = frameOf(push(300));
  host.write({next.begin(), next.end()});
  host.readFor(0.5e-3);
  EXPECT_THAT(model.violations(), ElementsAre(HasSubstr("faster")));
}

TEST_F(Watched, AfterALostReferenceForceGoesToZeroAsSlewAllowsAndStays) {
  homed();
  const double newton = -forceOf({1, 1, 1}, model.grip().rates()).z();
  model.limits({.force_rate = 100 * newton / 1e-3});
  for (const int counts : {100, 200, 300}) host.cycle(push(counts));
  model.grip().loseReference(0);
  host.cycle(push(300));  // the reply to this one reports the loss
  for (const int counts : {200, 100, 0, 0, 0}) host.cycle(push(counts));
  EXPECT_THAT(model.violations(), IsEmpty());
  host.cycle(push(50));
  EXPECT_THAT(model.violations(), ElementsAre(HasSubstr("after a reference was lost")));
}

TEST_F(Watched, AForceThatStaysAfterALostReferenceIsSeen) {
  homed();
  const double newton = -forceOf({1, 1, 1}, model.grip().rates()).z();
  model.limits({.force_rate = 100 * newton / 1e-3});
  for (const int counts : {100, 200, 300}) host.cycle(push(counts));
  model.grip().loseReference(0);
  host.cycles(push(300), 4);
  EXPECT_THAT(model.violations(), testing::Each(HasSubstr("after a reference was lost")));
  EXPECT_FALSE(model.violations().empty());
}

// Without a slew limit the force must be zero at once.
TEST_F(Watched, WithoutASlewLimitALostReferenceMeansZeroAtOnce) {
  homed();
  host.cycle(push(300));
  model.grip().loseReference(0);
  host.cycle(push(300));
  host.cycle(push(0));
  EXPECT_THAT(model.violations(), IsEmpty());
  FalconModel other{running()};
  Host stubborn{other};
  stubborn.toOperation();
  stubborn.cycles({}, 12);
  stubborn.cycle(push(300));
  other.grip().loseReference(0);
  stubborn.cycle(push(300));
  stubborn.cycle(push(1));
  EXPECT_THAT(other.violations(), ElementsAre(HasSubstr("after a reference was lost")));
}

TEST_F(Watched, MotorsHoldWhenNobodyTalks) {
  homed();
  host.cycle(push(300));
  host.readFor(0.5);
  EXPECT_TRUE(model.holdsForce());
  EXPECT_NEAR(model.quietFor(host.now), 0.501, 1e-3);
}

TEST_F(Watched, AfterAReplugForceNeedsHomingAgain) {
  homed();
  host.cycle(push(300));
  model.unplug(host.now);
  EXPECT_FALSE(model.holdsForce());
  host.transport.reset();
  model.plug(host.now);
  EXPECT_THAT(model.violations(), IsEmpty());
}

}  // namespace
}  // namespace presa::falcon_model::test
