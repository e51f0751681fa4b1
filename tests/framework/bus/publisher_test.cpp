// A whole run in lockstep, with and without viewers.
#include "framework/bus/publisher.h"

#include <gtest/gtest.h>

#include <map>
#include <vector>

#include "experiments/study/study_run.h"
#include "framework/bus/local_bus.h"
#include "framework/bus/remote_picture.h"
#include "framework/bus/rig_frames.h"
#include "framework/device/frame_watch.h"
#include "framework/device/frame_words.h"
#include "framework/session/load_world.h"
#include "framework/session/session.h"
#include "tests/support/alloc_lock_guard.h"

namespace presa::bus {
namespace {

const std::string kCube = std::string(PRESA_SOURCE_DIR) + "/config/scenes/cube.xml";

StudySpec cube() {
  StudySpec spec;
  spec.scene = kCube;
  spec.duration = 3;  // reach, squeeze, and most of the lift
  return spec;
}

StudyRun::MakeModule publisherOf(LocalBus& bus) {
  return [&bus](const std::shared_ptr<const World>& world) {
    return std::make_unique<Publisher>(world, RunOptions{}, [&bus] { return bus.writer(); });
  };
}

std::uint64_t hashWithoutBus() {
  StudyRun run(cube());
  run.run();
  return run.monitor().hash();
}

// Viewers that join, are slow, disappear and come back change no bit of any state.
TEST(Publisher, LeavesEveryBitOfTheRunAsItWas) {
  const std::uint64_t without = hashWithoutBus();
  LocalBus bus(1000);
  StudyRun run(cube(), {}, publisherOf(bus));
  const auto never_takes = bus.reader();
  std::unique_ptr<Reader> comes_and_goes;
  RemotePicture picture(run.world());
  int came = 0;
  run.observe([&](const HapticSample& sample) {
    if (sample.tick.index % 150 == 0) {
      comes_and_goes = bus.reader();
      ++came;
    }
    if (sample.tick.index % 150 < 100 && sample.tick.index % 7 == 0) comes_and_goes->take(picture);
  });
  run.run();
  EXPECT_EQ(run.monitor().hash(), without);
  EXPECT_EQ(came, 20);
  EXPECT_GT(picture.health().received, 1000u);
  EXPECT_GT(never_takes->overrun(), 0u);
}

// Viewers receive the states of the run to the bit, with poses at the tick's time, as a local view draws them.
TEST(Publisher, CarriesTheStatesOfTheRun) {
  LocalBus bus;
  StudyRun run(cube(), {}, publisherOf(bus));
  const auto reader = bus.reader();
  RemotePicture picture(run.world());
  double compared = 0;
  Pose X_WB;
  DeviceState device;
  ContactExchange contact;
  ForceCommand command;
  double time = -1;
  run.observe([&](const HapticSample& sample) {
    // published after this tick, so the current picture is that of five ticks ago
    if (sample.tick.index % 5 == 4) {
      reader->take(picture);
      picture.advance(std::numeric_limits<std::int64_t>::max() / 4);  // as far as possible
    }
    if (time >= 0 && sample.tick.index % 5 == 4) {
      ObjectState objects;
      DeviceState seen_device;
      ContactExchange seen_contact;
      ForceCommand seen_command;
      picture.fill(objects, seen_device, seen_contact, seen_command);
      ASSERT_EQ(picture.time(), time);
      ASSERT_EQ(objects.bodies[1].X_WB_end.p, X_WB.p);
      ASSERT_EQ(objects.bodies[1].X_WB_end.q.coeffs(), X_WB.q.coeffs());
      for (const std::size_t f : {0UL, 1UL}) {
        ASSERT_EQ(seen_device.fingers[f].p_WH, device.fingers[f].p_WH);
        ASSERT_EQ(seen_contact.fingers[f].f_H_W, contact.fingers[f].f_H_W);
        ASSERT_EQ(seen_contact.fingers[f].mode, contact.fingers[f].mode);
        ASSERT_EQ(seen_contact.fingers[f].p_BC, contact.fingers[f].p_BC);
        ASSERT_EQ(seen_command.f_H_W[f], command.f_H_W[f]);
      }
      ASSERT_EQ(seen_command.status, command.status);
      compared += 1;
    }
    if (sample.tick.index % 5 != 0 || sample.objects == nullptr) return;
    time = sample.tick.time;
    X_WB = sample.objects->poseAt(1, time);
    device = sample.device;
    contact = sample.contact;
    command = sample.command;
  });
  run.run();
  EXPECT_GT(compared, 590);
  EXPECT_EQ(picture.health().lost, 0u);
}

// A rig with a clutch: a viewer, whose own rig is only what the run's information says of it, has the frames to the bit
// and says the same of them. One period behind, so that each picture is a published moment.
TEST(Publisher, CarriesTheFramesOfTheRig) {
  StudySpec spec = cube();
  spec.rig = std::string(PRESA_SOURCE_DIR) + "/config/rigs/clutch_pair.xml";
  LocalBus bus;
  StudyRun run(spec, {}, publisherOf(bus));
  const auto reader = bus.reader();
  RunInfo info;
  info.frames = rigFrames(run.world().rig);
  info.places = placesOf(run.world());
  World there = run.world();
  there.rig = rigOf(info, there.scene);
  EXPECT_EQ(there.rig.devices[1].frame, "desk");
  RemotePicture picture(there), without([&] {
    World bare = run.world();
    bare.rig = {};
    return bare;
  }());
  std::map<double, FrameState> states;
  int compared = 0, clutched = 0;
  run.observe([&](const HapticSample& sample) {
    states[sample.tick.time] = run.session().frames()->last();
    if (sample.tick.index % 5 != 4) return;
    reader->take(picture);
    picture.advance(std::numeric_limits<std::int64_t>::max() / 4);  // as far as possible
    FrameState seen;
    picture.fill(seen);
    if (seen.frames.empty()) return;
    const FrameState& real = states.at(seen.time);
    ASSERT_EQ(seen.frames.size(), 3U);
    for (std::size_t n = 0; n < 3; ++n) {
      ASSERT_EQ(seen.frames[n].X_WF.p, real.frames[n].X_WF.p);
      ASSERT_EQ(seen.frames[n].X_WF.q.coeffs(), real.frames[n].X_WF.q.coeffs());
      ASSERT_EQ(seen.frames[n].zoom, real.frames[n].zoom);
      const std::string said = frameSentence(there.rig.frames[n], seen.frames[n]);
      ASSERT_EQ(said, frameSentence(run.world().rig.frames[n], real.frames[n]));
      clutched += said == "Clutch: 'desk' slides under the hand." ? 1 : 0;
    }
    ++compared;
  });
  const auto other = bus.reader();
  run.run();
  EXPECT_GT(compared, 590);
  EXPECT_GT(clutched, 190) << "the hand holds the button for a second";
  EXPECT_EQ(picture.health().lost, 0u);
  other->take(without);
  FrameState none(2);
  without.fill(none);
  EXPECT_TRUE(none.frames.empty()) << "a viewer that knows of no frames";
}

TEST(Publisher, GivesTheStaticPartToWhoComesLate) {
  LocalBus bus;
  StudyRun run(cube(), {}, publisherOf(bus));
  std::unique_ptr<Reader> late;
  run.observe([&](const HapticSample& sample) {
    if (sample.tick.index == 1500) late = bus.reader();
  });
  run.run();
  RemotePicture picture(run.world());
  late->take(picture);
  EXPECT_EQ(picture.state(), RemotePicture::State::kEnded);
  EXPECT_EQ(picture.health().lost, 0u);
  // half of 600 publications and the final one: one object, two fingers, one heartbeat each
  EXPECT_EQ(picture.health().received, 4u * (299 + 1 + 1));
}

// For the bus the haptic group only hands over its states.
TEST(Publisher, CostsTheHapticGroupNoAllocationAndNoLock) {
  if (!RealTimeGuard::active()) GTEST_SKIP() << "the sanitizers own these functions";
  Diagnostics diagnostics;
  Loaded loaded = loadWorld({kCube, "", {}}, {}, diagnostics);
  ASSERT_FALSE(diagnostics.hasErrors());
  LocalBus bus;
  const auto never_takes = bus.reader();
  RunControl control;
  Session::Options options;
  options.more.push_back(std::make_unique<Publisher>(loaded.world, loaded.options, [&] { return bus.writer(); }));
  const RateTable rates(loaded.world->scene.rates);
  Session session(std::move(loaded), control, std::move(options));
  constexpr std::array kGroups{RateGroup::kDynamics, RateGroup::kHaptic, RateGroup::kBus};
  for (const RateGroup group : kGroups) session.graph().start(group);
  int violations = 0, elsewhere = 0;
  for (std::uint64_t i = 0; i < 3000; ++i) {
    for (const RateGroup group : kGroups) {
      const auto divisor = static_cast<std::uint64_t>(rates.divisor(group));
      if (i % divisor != 0) continue;
      const RealTimeGuard guard;
      session.graph().step(group, rates.tick(group, i / divisor));
      (group == RateGroup::kHaptic ? violations : elsewhere) += guard.violations();
    }
  }
  for (const RateGroup group : kGroups) session.graph().stop(group);
  EXPECT_EQ(violations, 0);
  EXPECT_GT(elsewhere, 0);  // proof that the guard works: the bus itself takes a lock
}

}  // namespace
}  // namespace presa::bus
