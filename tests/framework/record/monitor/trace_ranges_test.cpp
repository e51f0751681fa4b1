#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/framework/record/monitor/synthetic_run.h"

namespace presa {
namespace {

// 80 Hz in samples at 125 Hz looks like 45 Hz; the ranges between the samples show all of it.
TEST(TraceRanges, KeepTheAmplitudeOfWhatIsFasterThanTheSamples) {
  test::Feed feed(2.0, 10, 125);
  for (int i = 0; i < 2000; ++i) {
    const double force = 3 + 2 * std::sin(2 * std::numbers::pi * 80 * i * 1e-3);
    feed.touch(0, ContactMode::kStick, force, 0.5);
    feed.command.f_H_W[0] = 0.5 * force * feed.contact.fingers[0].nhat_W;
    feed.tick();
  }
  const auto& trace = feed.monitor.trace();
  ASSERT_EQ(trace.size(), 250u);
  TraceRange rendered{9, 0}, commanded{9, 0};
  for (const TraceSample& sample : trace) {
    const TraceRanges& now = sample.ranges[0];
    rendered = {std::min(rendered.min, now.rendered_normal.min), std::max(rendered.max, now.rendered_normal.max)};
    commanded = {std::min(commanded.min, now.commanded_normal.min), std::max(commanded.max, now.commanded_normal.max)};
    EXPECT_LE(now.rendered_normal.min, sample.fingers[0].normal_force);
    EXPECT_GE(now.rendered_normal.max, sample.fingers[0].normal_force);
    EXPECT_EQ(now.rendered_tangential.max, 0.5);
  }
  EXPECT_NEAR(rendered.max, 5, 0.02);
  EXPECT_NEAR(rendered.min, 1, 0.02);
  EXPECT_NEAR(commanded.max, 2.5, 0.01);
  EXPECT_NEAR(commanded.min, 0.5, 0.01);
}

// A commanded force has a normal part only in contact; without one nothing of it is left out.
TEST(TraceRanges, CountAllForceWithoutContactAsNormal) {
  FingerContact contact;
  contact.nhat_W = Vec3::UnitX();
  EXPECT_EQ(partsOf(Vec3(3, 4, 0), contact).normal, 5);
  contact.mode = ContactMode::kStick;
  EXPECT_EQ(partsOf(Vec3(3, 4, 0), contact).normal, 3);
  EXPECT_EQ(partsOf(Vec3(3, 4, 0), contact).tangential, 4);
}

}  // namespace
}  // namespace presa
