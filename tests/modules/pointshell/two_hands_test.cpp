// Two hands with a tool each, or a tool and a fingertip, press a free cube from two sides and lift it.
#include <gtest/gtest.h>

#include <utility>

#include "framework/core/graph/module.h"
#include "framework/core/graph/port.h"
#include "framework/core/state/contact_exchange.h"
#include "framework/core/state/object_state.h"
#include "framework/session/run.h"

namespace presa::two_hands_test {
namespace {

constexpr double kWeight = 0.2 * 9.81;

/// Reads what the hands feel and where the bodies are, tick by tick.
struct HandsWatch final : Module {
  HandsWatch() : Module("hands_watch", RateGroup::kHaptic) {}
  void step(const Tick& tick) noexcept override {
    const Vec3 left = contact->fingers[0].f_H_W, right = contact->fingers[1].f_H_W;
    if (tick.time < 6) return;  // held still for two seconds
    mean_left += left;
    mean_right += right;
    ++ticks;
    if (objects.hasValue()) cube = objects->bodies[1].X_WB_end;
    stick = stick && contact->fingers[0].mode == ContactMode::kStick && contact->fingers[1].mode == ContactMode::kStick;
  }
  In<ContactExchange> contact{*this, "contact_exchange"};
  In<ObjectState> objects{*this, "object_state", In<ObjectState>::Optional{}};
  Vec3 mean_left = Vec3::Zero(), mean_right = Vec3::Zero();
  int ticks = 0;
  bool stick = true;
  Pose cube;
};

class TwoHands : public testing::TestWithParam<const char*> {};

// Oracle: the cube is at rest between the hands. What they press is equal and opposite, and what they feel downwards is
// its weight; a cube that hangs in their springs sinks by less than a millimetre.
TEST_P(TwoHands, LiftACubeBetweenThem) {
  Diagnostics diagnostics;
  RunOptions options;
  options.duration = 0;  // that of the script
  const std::string scene = PRESA_SOURCE_DIR "/tests/modules/pointshell/scene/" + std::string(GetParam());
  Loaded loaded = loadWorld({scene, {}, {}}, options, diagnostics);
  ASSERT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
  RunControl control;
  Session::Options more;
  auto made = std::make_unique<HandsWatch>();
  HandsWatch& watch = *made;
  more.more.push_back(std::move(made));
  presa::Run run(std::move(loaded), control, std::move(more));
  run.execute();
  ASSERT_GT(watch.ticks, 500);
  const Vec3 left = watch.mean_left / watch.ticks, right = watch.mean_right / watch.ticks;
  std::printf("left %.4f %.4f %.4f N, right %.4f %.4f %.4f N, cube at %.2f mm\n", left.x(), left.y(), left.z(),
              right.x(), right.y(), right.z(), 1e3 * watch.cube.p.z());
  EXPECT_LT(left.x(), -kWeight / 2 / 0.6) << "pressed hard enough to carry it";
  EXPECT_NEAR(left.x() + right.x(), 0, 0.01 * right.x());
  EXPECT_NEAR(left.y() + right.y(), 0, 0.01 * right.x());
  EXPECT_NEAR(left.z() + right.z(), -kWeight, 0.01 * kWeight);
  EXPECT_TRUE(watch.stick);
  EXPECT_NEAR(watch.cube.p.z(), 0.075, 0.003);
  EXPECT_LT(watch.cube.q.angularDistance(Quat::Identity()), 0.05) << "upright";
  EXPECT_FALSE(run.session().brokenPlugin());
  EXPECT_EQ(run.monitor().objectFaults(), 0U);
}

INSTANTIATE_TEST_SUITE_P(Scenes, TwoHands, testing::Values("two_hands.xml", "tool_and_finger.xml"));

}  // namespace
}  // namespace presa::two_hands_test
