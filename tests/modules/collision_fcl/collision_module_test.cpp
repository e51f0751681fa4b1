#include "modules/collision_fcl/collision_module.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <set>

#include "framework/geometry/closest_point.h"
#include "modules/collision_fcl/reach.h"

namespace presa {
namespace {

constexpr double kFingertip = 0.008;

template <class T>
struct Source final : Module {
  explicit Source(const char* port) : Module(port, RateGroup::kCollision), out(*this, port) {}
  void step(const Tick&) noexcept override {}
  Out<T> out;
};

/// A world of bodies under one finger, and the module with inputs as from haptic loop and dynamics.
class CollisionModuleTest : public testing::Test {
 protected:
  Body& addBody(const Shape& shape, const Pose& X_WB, const Pose& X_BG = {}) {
    Body body;
    body.name = "body" + std::to_string(world_.scene.bodies.size());
    body.X_WB = X_WB;
    body.fixed = true;
    body.haptic = Geometry{shape, X_BG, {}};
    world_.scene.bodies.push_back(body);
    world_.meshes.emplace_back();
    world_.inertias.emplace_back();
    return world_.scene.bodies.back();
  }
  Body& addMesh(TriMesh mesh, const Pose& X_WB, const Pose& X_BG = {}) {
    addBody(MeshRef{}, X_WB, X_BG);
    world_.meshes.back().haptic = std::make_shared<const TriMesh>(std::move(mesh));
    return world_.scene.bodies.back();
  }

  void start() {
    world_.scene.devices.resize(1);
    world_.scene.devices[0].fingertip_radius = kFingertip;
    indexHapticMeshes(world_);
    module_ = std::make_unique<CollisionModule>(std::make_shared<World>(world_));
    for (const Body& body : world_.scene.bodies) {
      BodyMotion motion;
      motion.X_WB_begin = motion.X_WB_end = body.X_WB;
      objects_.out.value.bodies.push_back(motion);
    }
    device_bridge_ = std::make_unique<Bridge<DeviceState>>(device_.out.value);
    device_bridge_->addReader(module_->device_state);
    objects_bridge_ = std::make_unique<Bridge<ObjectState>>(objects_.out.value);
    objects_bridge_->addReader(module_->object_state);
  }
  const FingerNeighbourhood& query(const Vec3& p_WH, const Vec3& v_WH = Vec3::Zero()) {
    if (!module_) start();
    device_.out.value.fingers.resize(1);
    device_.out.value.fingers[0].p_WH = p_WH;
    device_.out.value.fingers[0].v_WH = v_WH;
    for (BridgeBase* bridge : std::initializer_list<BridgeBase*>{device_bridge_.get(), objects_bridge_.get()}) {
      bridge->push(tick_);
      bridge->pull(RateGroup::kCollision, tick_);
    }
    module_->step(tick_);
    return module_->finger_neighbourhoods.value.fingers[0];
  }
  BodyMotion& motionOf(std::size_t body) { return objects_.out.value.bodies[body]; }

  /// Every triangle of a listed mesh within the radius of its cut must be in the cut, in body coordinates.
  void expectComplete(const NearBody& near) const {
    const auto b = static_cast<std::size_t>(near.body);
    const MeshTree& tree = *world_.meshes[b].haptic_tree;
    const Pose& X_BG = world_.scene.bodies[b].haptic->X_BG;
    std::set<std::int32_t> held;
    for (std::int32_t i = 0; i < near.cut_count; ++i) {
      tree.forEachWithin(
          Vec3::Zero(), 1e9, [&](std::int32_t f) { held.insert(f); }, near.cut[static_cast<std::size_t>(i)]);
    }
    for (std::int32_t f = 0; f < static_cast<std::int32_t>(tree.mesh().triangles.size()); ++f) {
      const auto at = [&](std::size_t k) -> Vec3 { return X_BG * tree.corner(tree.facet(f), k); };
      const double distance = (near.center_B - closestOnTriangle(near.center_B, at(0), at(1), at(2))).norm();
      // tolerance: rounding of two orders of transformation, a few ulp of a decimetre
      if (distance < near.radius - 1e-15) {
        EXPECT_TRUE(held.contains(f)) << "facet " << f << " at " << distance;
      }
    }
  }

  World world_;
  Tick tick_{0, 0.0, 0.01};
  Source<DeviceState> device_{"device_state"};
  Source<ObjectState> objects_{"object_state"};
  std::unique_ptr<CollisionModule> module_;
  std::unique_ptr<Bridge<DeviceState>> device_bridge_;
  std::unique_ptr<Bridge<ObjectState>> objects_bridge_;
};

const Pose kPlaced{Vec3(0.4, -0.2, 0.1), Quat(Eigen::AngleAxisd(0.9, Vec3(1, 2, -1).normalized()))};
const Pose kInBody{Vec3(0.01, 0.03, -0.02), Quat(Eigen::AngleAxisd(-0.5, Vec3(0, 1, 3).normalized()))};

// The invariant of a neighbourhood: it covers everything that can be touched before the next one, at any pose of body
// and mesh.
TEST_F(CollisionModuleTest, TheCutHoldsEveryTriangleWithinItsRadius) {
  addMesh(makeSphere(0.05, 4), kPlaced, kInBody);
  const Vec3 finger = kPlaced * (kInBody * Vec3(0.0, 0.0, 0.056));
  const FingerNeighbourhood& neighbourhood = query(finger);
  ASSERT_EQ(neighbourhood.body_count, 1);
  ASSERT_GT(neighbourhood.bodies[0].cut_count, 1);
  EXPECT_LT((kPlaced * neighbourhood.bodies[0].center_B - finger).norm(), 1e-15);
  expectComplete(neighbourhood.bodies[0]);
}

// The same under every index, while the finger goes round the mesh.
struct UnderIndex : CollisionModuleTest, testing::WithParamInterface<CollisionSettings::Index> {};

TEST_P(UnderIndex, TheCutHoldsEveryTriangleWithinItsRadius) {
  addMesh(makeSphere(0.05, 4), kPlaced, kInBody);
  world_.scene.collision = {.index = GetParam(), .margin = 0.002};
  for (double angle = 0; angle < 6; angle += 0.3) {
    const Vec3 finger(0.056 * std::sin(angle), 0.01 * std::sin(3 * angle), 0.056 * std::cos(angle));
    const FingerNeighbourhood& neighbourhood = query(kPlaced * (kInBody * finger));
    ASSERT_EQ(neighbourhood.body_count, 1);
    ASSERT_GT(neighbourhood.bodies[0].cut_count, 1);
    expectComplete(neighbourhood.bodies[0]);
  }
}
INSTANTIATE_TEST_SUITE_P(EveryIndex, UnderIndex,
                         testing::Values(CollisionSettings::Index::kTree, CollisionSettings::Index::kObb,
                                         CollisionSettings::Index::kHcollide));

// The path of a finger over the horizon, at constant velocity or acceleration, lies within the bound.
TEST_F(CollisionModuleTest, RadiusGrowsByTheWayTheFingerCanGo) {
  addMesh(makeBox({0.1, 0.1, 0.1}), {});
  const double still = query({0, 0, 0.06}).radius;
  const double moving = query({0, 0, 1.06}, {0.3, 0, 0.4}).radius;
  const double horizon = 2 * 0.01 + 1 / world_.scene.rates.dynamics;
  constexpr double kFarther =
      1.5;  // a neighbourhood is 1.5 times as large as needed, so that it serves for several queries
  EXPECT_NEAR(still, kFarther * (1.1 * kFingertip + reach::kMargin + 0.5 * reach::kAcceleration * horizon * horizon),
              1e-15);
  EXPECT_NEAR(moving - still, kFarther * 0.5 * horizon, 1e-15);
}

// A neighbourhood serves until it no longer covers the finger's need; the need is always covered, on any path.
TEST_F(CollisionModuleTest, ANeighbourhoodServesUntilTheFingerNeedsMore) {
  addMesh(makeSphere(0.05, 4), kPlaced, kInBody);
  const double needed = 1.1 * kFingertip + reach::kMargin + 0.5 * reach::kAcceleration * 0.025 * 0.025;
  ASSERT_NEAR(1 / world_.scene.rates.dynamics, 0.005, 1e-15);
  int made = 0;
  double way = 0;
  std::uint64_t serial = 0;
  Vec3 last = Vec3::Zero();
  for (double angle = 0; angle < 1; angle += 0.01) {  // 0.56 mm per query
    const Vec3 finger = kPlaced * (kInBody * Vec3(0.056 * std::sin(angle), 0, 0.056 * std::cos(angle)));
    const FingerNeighbourhood& neighbourhood = query(finger);
    if (neighbourhood.serial != serial) ++made;
    serial = neighbourhood.serial;
    ASSERT_GE(neighbourhood.radius, (neighbourhood.center_W - finger).norm() + needed - 1e-15);
    ASSERT_EQ(neighbourhood.body_count, 1);
    expectComplete(neighbourhood.bodies[0]);
    way += last.isZero() ? 0 : (finger - last).norm();
    last = finger;
  }
  EXPECT_LE(made, 2 + way / (0.5 * needed));  // the extra half of the radius lasts for half of the need
}

// The scene may set a fixed margin instead.
TEST_F(CollisionModuleTest, ObeysTheScenesMargin) {
  addMesh(makeSphere(0.02, 3), {});
  world_.scene.collision.margin = 0.002;
  EXPECT_NEAR(query({0, 0, 0.028}, {0.3, 0, 0.4}).radius, 1.1 * kFingertip + 0.002, 1e-15);
}

TEST_F(CollisionModuleTest, WhatIsOutOfReachIsNotListed) {
  addMesh(makeSphere(0.05, 3), {});
  EXPECT_EQ(query({0, 0, 0.4}).body_count, 0);
  EXPECT_GT(query({0, 0, 0.4}).radius, 0);
  EXPECT_LT(query({0, 0, std::numeric_limits<double>::quiet_NaN()}).radius, 0);
}

// An approaching body is listed before the finger can reach it, primitives and meshes. Oracle: the bounding spheres of
// all bodies.
TEST_F(CollisionModuleTest, EveryBodyInReachIsListedWhereverItGoes) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto place = [&] {
    return Pose{0.3 * Vec3(uniform(random), uniform(random), uniform(random)), Quat::Identity()};
  };
  for (int i = 0; i < 40; ++i) {
    (i % 2 == 0 ? addBody(Box{{0.01, 0.02, 0.03}}, place()) : addMesh(makeBox({0.02, 0.02, 0.02}), place())).fixed =
        i < 10;
  }
  const auto radiusOf = [&](std::size_t b) {
    return b % 2 == 0 ? 0.5 * Vec3(0.01, 0.02, 0.03).norm() : 0.5 * Vec3(0.02, 0.02, 0.02).norm();
  };
  std::size_t listed = 0;
  for (int round = 0; round < 200; ++round) {
    Vec3 finger = 0.2 * Vec3(uniform(random), uniform(random), uniform(random));
    const FingerNeighbourhood& neighbourhood = query(finger);
    std::set<std::int32_t> there;
    for (std::int32_t i = 0; i < neighbourhood.body_count; ++i)
      there.insert(neighbourhood.bodies[static_cast<std::size_t>(i)].body);
    for (std::size_t b = 0; b < world_.scene.bodies.size(); ++b) {
      const double gap = (motionOf(b).X_WB_end.p - neighbourhood.center_W).norm() - radiusOf(b);
      if (gap <= neighbourhood.radius) {
        EXPECT_TRUE(there.contains(static_cast<std::int32_t>(b))) << round << ' ' << b;
      }
    }
    listed += there.size();
    for (std::size_t b = 10; b < world_.scene.bodies.size(); ++b) {
      motionOf(b).X_WB_begin = motionOf(b).X_WB_end = place();
      motionOf(b).v_WB = 0.1 * Vec3(uniform(random), uniform(random), uniform(random));
    }
  }
  EXPECT_GT(listed, 50u);
  EXPECT_LT(listed, 200u * 40);
}

// Too many bodies: the neighbourhood marks itself as unusable, and the tick examines all of them itself.
TEST_F(CollisionModuleTest, ACrowdIsLeftToTheTick) {
  for (int i = 0; i < kMaxNearBodies + 1; ++i) addBody(Sphere{0.001}, {Vec3(0, 1e-4 * i, 0.01), Quat::Identity()});
  EXPECT_LT(query(Vec3::Zero()).radius, 0);
}

// Room is taken for the scene's devices only, and a finger beyond them is left to the tick.
TEST_F(CollisionModuleTest, RoomIsThatOfTheScenesDevices) {
  addBody(Sphere{0.01}, {});
  query(Vec3::Zero());
  const FingerNeighbourhoods& neighbourhoods = module_->finger_neighbourhoods.value;
  EXPECT_EQ(neighbourhoods.fingers.size(), 1u);
  EXPECT_EQ(neighbourhoods.roomBytes(), sizeof(FingerNeighbourhood));
  device_.out.value.fingers.resize(2);
  device_bridge_->push({});
  device_bridge_->pull(RateGroup::kCollision, {});
  module_->step(tick_);
  EXPECT_EQ(neighbourhoods.count, 1);
}

// Three slots of a triple buffer, copied to in turn while neighbourhoods change one by one: every copy equals its
// source.
TEST(FingerNeighbourhoods, ACopyIsWhatItsSourceWasWhateverItHeldBefore) {
  auto source = std::make_unique<FingerNeighbourhoods>();
  source->fingers.resize(3);
  std::array<std::unique_ptr<FingerNeighbourhoods>, 3> slots;
  for (auto& slot : slots) slot = std::make_unique<FingerNeighbourhoods>();
  for (std::uint64_t round = 1; round < 30; ++round) {
    source->count = 1 + static_cast<int>(round % 3);
    FingerNeighbourhood& changed = source->fingers[round % 3];
    changed.serial = round;
    changed.radius = static_cast<double>(round);
    changed.body_count = static_cast<int>(round % 7);
    for (std::size_t b = 0; b < round % 7; ++b) {
      changed.bodies[b].body = static_cast<std::int32_t>(100 * round + b);
      changed.bodies[b].cut_count = 2;
      changed.bodies[b].cut[1] = static_cast<std::int32_t>(round);
    }
    FingerNeighbourhoods& slot = *slots[round / 2 % 3];
    slot = *source;
    ASSERT_EQ(slot.count, source->count);
    ASSERT_EQ(slot.fingers.size(), source->fingers.size());
    for (std::size_t f = 0; f < static_cast<std::size_t>(slot.count); ++f) {
      const FingerNeighbourhood &copy = slot.fingers[f], &original = source->fingers[f];
      ASSERT_EQ(copy.serial, original.serial);
      ASSERT_EQ(copy.radius, original.radius);
      ASSERT_EQ(copy.body_count, original.body_count);
      for (std::size_t b = 0; b < static_cast<std::size_t>(copy.body_count); ++b) {
        ASSERT_EQ(copy.bodies[b].body, original.bodies[b].body);
        ASSERT_EQ(copy.bodies[b].cut[1], original.bodies[b].cut[1]);
      }
    }
  }
}

}  // namespace
}  // namespace presa
