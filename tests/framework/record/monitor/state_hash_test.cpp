#include "framework/record/monitor/state_hash.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "tests/framework/record/monitor/synthetic_run.h"

namespace presa {
namespace {

/// All hashed states, so that each field can be changed in turn.
struct States {
  DeviceState device;
  ContactExchange contact;
  ObjectState objects;
  std::uint64_t hash() const {
    StateHash hash;
    hash.add(device);
    hash.add(contact);
    hash.add(objects);
    return hash.value();
  }
};

States filledStates() {
  States s;
  s.device = DeviceState(2);
  s.contact = ContactExchange(2);
  s.objects.finger_impulse_W.assign(2, Vec3::Zero());
  s.objects.bodies.resize(2);
  return s;
}

// Changing any single field changes the hash.
TEST(StateHash, EveryFieldCounts) {
  const std::vector<std::function<void(States&)>> changes{
      [](States& s) { s.device.time = 1e-300; },
      [](States& s) { s.device.stop_requested = true; },
      [](States& s) { s.device.fingers.resize(1); },
      [](States& s) { s.device.fingers[1].p_WH.z() = 1e-9; },
      [](States& s) { s.device.fingers[1].v_WH.x() = 1e-9; },
      [](States& s) { s.device.fingers[0].phase = 3; },
      [](States& s) { s.device.fingers[0].valid = true; },
      [](States& s) { s.contact.time = 1; },
      [](States& s) { s.contact.coverage_lost = 1; },
      [](States& s) { s.contact.pop_through = 1; },
      [](States& s) { s.contact.pop_through_by_finger[1] = 1; },
      [](States& s) { s.contact.fingers[1].mode = ContactMode::kSlip; },
      [](States& s) { s.contact.fingers[1].body = 7; },
      [](States& s) { s.contact.fingers[1].p_WH.x() = 1; },
      [](States& s) { s.contact.fingers[1].v_WH.y() = 1; },
      [](States& s) { s.contact.fingers[1].p_WP.z() = 1; },
      [](States& s) { s.contact.fingers[1].p_BP.x() = 1; },
      [](States& s) { s.contact.fingers[1].p_BC.y() = 1; },
      [](States& s) { s.contact.fingers[1].nhat_B.z() = -1; },
      [](States& s) { s.contact.fingers[1].nhat_W.z() = -1; },
      [](States& s) { s.contact.fingers[1].depth = 1; },
      [](States& s) { s.contact.fingers[1].stiffness = 1; },
      [](States& s) { s.contact.fingers[1].damping = 1; },
      [](States& s) { s.contact.fingers[1].friction_static = 1; },
      [](States& s) { s.contact.fingers[1].friction_dynamic = 1; },
      [](States& s) { s.contact.fingers[1].normal_force = 1; },
      [](States& s) { s.contact.fingers[1].tangential_force_W.x() = 1; },
      [](States& s) { s.contact.fingers[1].f_H_W.y() = 1; },
      [](States& s) { s.objects.time_begin = 1; },
      [](States& s) { s.objects.time_end = 1; },
      [](States& s) { s.objects.bodies.resize(1); },
      [](States& s) { s.objects.faults = kFaultBadFinger; },
      [](States& s) { s.objects.fallback_steps = 1ULL << 40; },
      [](States& s) { s.objects.penetration.points = 1; },
      [](States& s) { s.objects.penetration.mean = 1; },
      [](States& s) { s.objects.penetration.worst = 1; },
      [](States& s) { s.objects.finger_impulse_W[1].y() = 1; },
      [](States& s) { s.objects.bodies[1].X_WB_begin.p.x() = 1; },
      [](States& s) { s.objects.bodies[1].X_WB_begin.q.x() = 1; },
      [](States& s) { s.objects.bodies[1].X_WB_end.p.y() = 1; },
      [](States& s) { s.objects.bodies[1].X_WB_end.q.w() = -1; },
      [](States& s) { s.objects.bodies[1].v_WB.z() = 1; },
      [](States& s) { s.objects.bodies[1].w_WB.x() = 1; },
      [](States& s) { s.objects.bodies[1].asleep = true; },
  };
  std::vector<std::uint64_t> seen{filledStates().hash()};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    States s = filledStates();
    changes[i](s);
    const std::uint64_t hash = s.hash();
    for (const std::uint64_t other : seen) EXPECT_NE(hash, other) << "change " << i;
    seen.push_back(hash);
  }
}

// The hash covers bits, not values: -0 and +0 differ, and a NaN hashes like the same NaN.
TEST(StateHash, SignedZeroAndNanAreTakenAsTheyAre) {
  States zero = filledStates(), negative = filledStates(), nan = filledStates(), nan_again = filledStates();
  negative.contact.fingers[0].depth = -0.0;
  nan.contact.fingers[0].depth = nan_again.contact.fingers[0].depth = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(zero.hash(), negative.hash());
  EXPECT_EQ(nan.hash(), nan_again.hash());
  EXPECT_NE(nan.hash(), zero.hash());
}

// Padding and unused entries are not part of the hash.
TEST(StateHash, PaddingAndUnusedEntriesDoNotCount) {
  std::vector<unsigned char> memory(sizeof(States));
  std::vector<std::uint64_t> hashes;
  for (const int fill : {0x00, 0xff}) {
    std::memset(memory.data(), fill, memory.size());
    // default-initialised, so that padding keeps the fill pattern
    States* s = new (memory.data()) States;
    s->objects.bodies.resize(2);
    s->objects.bodies[1].v_WB = Vec3::Constant(fill);
    s->objects.bodies.resize(1);
    s->device.fingers.resize(2);
    s->device.fingers[1].p_WH = Vec3::Constant(fill);
    s->device.fingers.resize(1);
    s->contact = ContactExchange(1, 3);
    s->contact.contacts.add()->depth = fill;
    s->contact.contacts.clear();
    hashes.push_back(s->hash());
    s->~States();
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

// The same states in another order give another hash.
TEST(StateHash, MonitorHashFollowsTheWholePath) {
  const auto run = [](double first, double second) {
    test::Feed feed(1);
    feed.place(Vec3(0, 0, first));
    feed.ticks(5);
    feed.place(Vec3(0, 0, second));
    feed.ticks(5);
    return feed.monitor.hash();
  };
  EXPECT_EQ(run(0.1, 0.2), run(0.1, 0.2));
  EXPECT_NE(run(0.1, 0.2), run(0.2, 0.1));
}

// An object state is hashed once, at the tick of its arrival, however many ticks read it.
TEST(StateHash, ObjectStateCountsWhenItArrives) {
  const auto run = [](int arrival) {
    test::Feed feed(1);
    feed.ticks(arrival);
    feed.place(Vec3(0, 0, 0.1));
    feed.ticks(10 - arrival);
    return feed.monitor.hash();
  };
  EXPECT_NE(run(4), run(5));
}

}  // namespace
}  // namespace presa
