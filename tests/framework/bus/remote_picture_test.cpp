#include "framework/bus/remote_picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "framework/bus/local_bus.h"
#include "framework/bus/scene_hash.h"
#include "framework/bus/troubled_reader.h"
#include "framework/scene/load.h"

namespace presa::bus {
namespace {

constexpr double kPeriod = 0.005;

World worldOf(const std::string& size = "0.1") {
  Diagnostics diagnostics;
  const std::string xml = R"(<scene version="1.0" name="s"><world gravity="0 0 0"/>
    <materials><material name="wood" stiffness="1000"/></materials>
    <body name="table" fixed="true"><haptic><box size="1 1 )" +
                          size + R"("/></haptic></body>
    <body name="a"><physics mass="1"><sphere radius="0.1"/></physics></body>
    <devices><device role="thumb"/></devices></scene>)";
  Scene scene = parseScene(xml, "test", ".", {}, diagnostics);
  World world = buildWorld(std::move(scene), {}, diagnostics);
  EXPECT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
  return world;
}

std::int64_t ns(double seconds) { return std::llround(seconds * 1e9); }

/// Position of the body at time t [m]: it moves along x at 1 m/s, so that positions equal times.
double where(double t) { return t; }

/// A simulated sender and a picture of its run. `delay`: transport delay [s].
struct Wire {
  explicit Wire(const World& world) : world_hash(sceneHash(world)), picture(world) {}
  void announce(std::uint64_t id) {
    run = {id, world_hash, kPeriod, false, "s", "<scene/>"};
    sequence = 0;
    picture.onRun(run, ns(clock));
  }
  Stamp stampOf(std::uint64_t number) const {
    return {run.run, number, static_cast<double>(number - 1) * kPeriod, ns(clock)};
  }
  void send(std::uint64_t number, double delay = 0) {
    ObjectSample object;
    object.stamp = stampOf(number);
    object.body = 1;
    object.X_WB.p.x() = where(object.stamp.time);
    picture.onObject(object, ns(clock + delay));
    FingerSample finger;
    finger.stamp = object.stamp;
    finger.finger = 0;
    finger.valid = true;
    finger.p_WH.x() = 2 * where(object.stamp.time);
    picture.onFinger(finger, ns(clock + delay));
    Heartbeat heartbeat;
    heartbeat.stamp = object.stamp;
    picture.onHeartbeat(heartbeat, ns(clock + delay));
  }
  /// Sends and delivers this many periods.
  void go(int periods) {
    for (int i = 0; i < periods; ++i) {
      send(++sequence);
      picture.advance(ns(clock));
      clock += kPeriod;
    }
  }
  double shown() {
    picture.fill(objects, device, contact, command);
    return objects.bodies[1].X_WB_end.p.x();
  }

  std::uint64_t world_hash;
  RemotePicture picture;
  RunInfo run;
  std::uint64_t sequence = 0;
  double clock = 1000;  // the viewer's clock, unrelated to the run's
  ObjectState objects;
  DeviceState device;
  ContactExchange contact;
  ForceCommand command;
};

// One period behind, and interpolated between samples: uniform motion is shown without error.
TEST(RemotePicture, ShowsThePastPeriodWithoutError) {
  Wire wire(worldOf());
  wire.announce(7);
  wire.go(20);
  const double newest = 19 * kPeriod, received = wire.clock - kPeriod;
  for (const double later : {0.0, 0.1, 0.3, 0.5, 0.9, 1.0}) {
    wire.picture.advance(ns(received + later * kPeriod));
    const double expected = newest - kPeriod + later * kPeriod;
    EXPECT_NEAR(wire.picture.time(), expected, 2e-9);  // the clock counts whole nanoseconds
    EXPECT_NEAR(wire.shown(), where(wire.picture.time()), 1e-12);
    EXPECT_NEAR(wire.device.fingers[0].p_WH.x(), 2 * where(wire.picture.time()), 1e-12);
    EXPECT_TRUE(wire.device.fingers[0].valid);
  }
  // never ahead of the newest state
  wire.picture.advance(ns(received + 3 * kPeriod));
  EXPECT_EQ(wire.picture.time(), newest);
}

TEST(RemotePicture, BridgesALostSampleAndTakesALateOne) {
  Wire wire(worldOf());
  wire.announce(7);
  wire.go(10);
  wire.sequence += 2;  // 11 and 12 are lost or late
  wire.clock += 2 * kPeriod;
  wire.go(1);
  wire.picture.advance(ns(wire.clock - kPeriod));
  EXPECT_NEAR(wire.shown(), where(11 * kPeriod), 1e-12);  // between 10 and 13
  EXPECT_EQ(wire.picture.health().lost, 6u);              // object, finger and heartbeat of both
  wire.send(12);
  wire.send(12);
  EXPECT_EQ(wire.picture.health().lost, 3u);
  EXPECT_EQ(wire.picture.health().late, 3u);
  EXPECT_EQ(wire.picture.health().doubled, 3u);
  EXPECT_EQ(wire.picture.health().received, 3u * 12);
  EXPECT_NEAR(wire.shown(), where(11 * kPeriod), 1e-12);
}

// Occasional late packets do not shift the picture: its time advances evenly.
TEST(RemotePicture, GoesOnEvenlyUnderJitter) {
  Wire wire(worldOf());
  wire.announce(7);
  wire.go(20);
  wire.picture.advance(ns(wire.clock));
  RandomStream random(1, "jitter");
  double before = wire.picture.time();
  for (int i = 0; i < 400; ++i) {
    wire.send(++wire.sequence, random.uniform(0, 0.8 * kPeriod));
    wire.clock += kPeriod;
    wire.picture.advance(ns(wire.clock));
    EXPECT_NEAR(wire.picture.time() - before, kPeriod, 0.02 * kPeriod) << i;
    before = wire.picture.time();
  }
}

TEST(RemotePicture, FreezesAndComesBack) {
  Wire wire(worldOf());
  wire.announce(7);
  wire.go(50);
  EXPECT_EQ(wire.picture.state(), RemotePicture::State::kLive);
  const double last = 49 * kPeriod;
  wire.clock += 1.0 - kPeriod;
  wire.picture.advance(ns(wire.clock));
  EXPECT_EQ(wire.picture.state(), RemotePicture::State::kFrozen);
  EXPECT_TRUE(wire.picture.alarm());
  EXPECT_NE(wire.picture.line().find("FROZEN: nothing on the bus for 1.0 s"), std::string::npos) << wire.picture.line();
  EXPECT_EQ(wire.shown(), where(last));
  EXPECT_TRUE(wire.device.fingers[0].valid);  // the whole picture is kept
  // the run went on meanwhile: 200 publications are lost, and the next is shown at once
  wire.sequence += 200;
  wire.go(2);
  EXPECT_EQ(wire.picture.state(), RemotePicture::State::kLive);
  EXPECT_FALSE(wire.picture.alarm());
  EXPECT_EQ(wire.picture.health().resumed, 1u);
  EXPECT_EQ(wire.picture.health().lost, 600u);
  EXPECT_NEAR(wire.shown(), where(250 * kPeriod), 1e-9);
  EXPECT_TRUE(wire.device.fingers[0].valid);
}

TEST(RemotePicture, SaysThatAnotherSceneRuns) {
  Wire wire(worldOf());
  wire.world_hash = sceneHash(worldOf("0.2"));
  wire.announce(7);
  wire.go(10);
  EXPECT_TRUE(wire.picture.wrongScene());
  EXPECT_TRUE(wire.picture.alarm());
  EXPECT_EQ(wire.picture.health().other_scene, 30u);
  EXPECT_NE(wire.picture.line().find("another scene"), std::string::npos);
  EXPECT_EQ(wire.shown(), 0);  // start pose of the viewer's own scene
}

// The next run starts where the last was killed: other numbers and times, no loss between them.
TEST(RemotePicture, FollowsTheNextRun) {
  Wire wire(worldOf());
  wire.announce(7);
  wire.go(500);
  wire.announce(8);  // while the first still sends: it is not followed yet
  EXPECT_EQ(wire.picture.health().received, 1500u);
  wire.go(3);
  EXPECT_EQ(wire.picture.health().received, 1500u);
  wire.clock += 1;
  wire.picture.advance(ns(wire.clock));
  wire.go(5);
  EXPECT_EQ(wire.picture.health().received, 1515u);
  EXPECT_EQ(wire.picture.health().lost, 0u);
  EXPECT_NEAR(wire.shown(), where(6 * kPeriod), 1e-9);
}

TEST(RemotePicture, SaysThatTheRunHasEnded) {
  Wire wire(worldOf());
  wire.announce(7);
  wire.go(10);
  Heartbeat heartbeat;
  heartbeat.stamp = wire.stampOf(11);
  heartbeat.last = true;
  wire.picture.onHeartbeat(heartbeat, ns(wire.clock));
  wire.clock += 10;
  wire.picture.advance(ns(wire.clock));
  EXPECT_EQ(wire.picture.state(), RemotePicture::State::kEnded);
  EXPECT_FALSE(wire.picture.alarm());
}

TEST(RemotePicture, ShowsAnEvent) {
  Wire wire(worldOf());
  wire.announce(7);
  wire.go(10);
  wire.picture.onEvent({wire.stampOf(10), Event::Kind::kObjectFault, kFaultBodyFrozen}, ns(wire.clock));
  EXPECT_NE(wire.picture.line().find("0.045 s: a body froze"), std::string::npos) << wire.picture.line();
  EXPECT_TRUE(wire.picture.alarm());
}

// The counters equal the losses, duplicates and delays that the reader introduced.
TEST(RemotePicture, CountsWhatABadNetworkDoes) {
  const World world = worldOf();
  LocalBus bus;
  const auto writer = bus.writer();
  TroubledReader reader(bus.reader(), {}, 3);
  RemotePicture picture(world);
  writer->announce({7, sceneHash(world), kPeriod, false, "s", ""});
  Heartbeat heartbeat;
  const auto publish = [&] {
    heartbeat.stamp = {7, heartbeat.stamp.sequence + 1, static_cast<double>(heartbeat.stamp.sequence) * kPeriod, 0};
    ObjectSample object;
    object.stamp = heartbeat.stamp;
    object.body = 1;
    writer->publish({std::span(&object, 1), {}, heartbeat});
    reader.take(picture);
  };
  publish();  // counting starts with the first
  reader.change({.lose = 0.1, .twice = 0.1, .hold_back = 0.2});
  for (int i = 0; i < 3000; ++i) publish();
  reader.change({});
  publish();
  publish();
  const RemotePicture::Health health = picture.health();
  EXPECT_GT(reader.lost(), 500u);
  EXPECT_EQ(health.lost, reader.lost());
  EXPECT_EQ(health.doubled, reader.doubled());
  EXPECT_GT(health.late, 0u);
  EXPECT_LE(health.late, reader.heldBack());  // some are delayed past a loss
  EXPECT_EQ(health.received, 2u * 3003 - reader.lost());
}

// Samples discarded on the reader's side are counted separately from network loss.
TEST(LocalBus, CountsWhatAReaderLeavesLying) {
  LocalBus bus(10);
  const auto writer = bus.writer();
  const auto reader = bus.reader();
  for (std::uint64_t n = 1; n <= 25; ++n) {
    Heartbeat heartbeat;
    heartbeat.stamp.sequence = n;
    writer->publish({{}, {}, heartbeat});
  }
  EXPECT_EQ(reader->overrun(), 15u);
}

TEST(SceneHash, DiffersByWhatIsDrawn) {
  EXPECT_EQ(sceneHash(worldOf()), sceneHash(worldOf()));
  EXPECT_NE(sceneHash(worldOf()), sceneHash(worldOf("0.2")));
}

// Forged samples with extreme numbers and times do not stop the picture.
TEST(RemotePicture, ForgedNumbersAndTimesStopNothing) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Stamp ends[] = {{7, ~std::uint64_t{0}, 1, 0},
                        {7, std::uint64_t{1} << 63U, 1, 0},
                        {7, 0, 1e300, 0},
                        {7, 0, std::nan(""), 0},
                        {7, 0, kInfinity, 0},
                        {7, 0, -kInfinity, 0},
                        {7, 0, -1e300, 0}};
  for (Stamp forged : ends) {
    Wire wire(worldOf());
    wire.announce(7);
    wire.go(400);
    const bool number = forged.time == 1;  // else the time is forged, with the next number
    if (number)
      forged.time = wire.stampOf(wire.sequence).time;
    else
      forged.sequence = wire.sequence + 1;
    ObjectSample object;
    object.stamp = forged;
    object.body = 1;
    object.X_WB.p.x() = 99;
    wire.picture.onObject(object, ns(wire.clock));
    Heartbeat last;
    last.stamp = forged;
    last.last = true;
    wire.picture.onHeartbeat(last, ns(wire.clock));
    wire.go(100);
    EXPECT_EQ(wire.picture.state(), RemotePicture::State::kLive) << forged.sequence << ' ' << forged.time;
    EXPECT_NEAR(wire.shown(), where(498 * kPeriod), 2 * kPeriod) << forged.sequence << ' ' << forged.time;
    EXPECT_EQ(wire.picture.health().strays, 2u) << forged.sequence << ' ' << forged.time;
    EXPECT_EQ(wire.picture.health().lost, 0u);
  }
}

}  // namespace
}  // namespace presa::bus
