#include "modules/collision_fcl/collision_module.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "framework/geometry/closest_point.h"
#include "modules/collision_fcl/reach.h"

namespace presa {
namespace {

constexpr double kFingertip = 0.008;

/// A world of mesh bodies under one finger, and the module as the haptic loop would feed it.
class CollisionModuleTest : public testing::Test {
 protected:
  void addBody(TriMesh mesh, const Pose& X_WB, const Pose& X_BG = {}) {
    Body body;
    body.name = "body" + std::to_string(world_.scene.bodies.size());
    body.X_WB = X_WB;
    body.haptic = Geometry{MeshRef{}, X_BG, {}};
    world_.scene.bodies.push_back(body);
    world_.meshes.push_back({nullptr, std::make_shared<const TriMesh>(std::move(mesh)), nullptr});
    world_.inertias.emplace_back();
  }

  const ContactPatches& query(const Vec3& p_WH, const Vec3& v_WH = Vec3::Zero()) {
    world_.scene.devices.resize(1);
    world_.scene.devices[0].fingertip_radius = kFingertip;
    if (!module_) module_ = std::make_unique<CollisionModule>(std::make_shared<World>(world_));
    device_.device_state.value.count = 1;
    device_.device_state.value.fingers[0].p_WH = p_WH;
    device_.device_state.value.fingers[0].v_WH = v_WH;
    feed();
    module_->step(tick_);
    return module_->contact_patches.value;
  }

  struct Device final : Module {
    Device() : Module("device", RateGroup::kCollision) {}
    void step(const Tick&) noexcept override {}
    Out<DeviceState> device_state{*this, "device_state"};
  };
  void feed() {
    if (!bridge_) {
      bridge_ = std::make_unique<Bridge<DeviceState>>(device_.device_state.value);
      bridge_->addReader(module_->device_state);
    }
    bridge_->push(tick_.time);
    bridge_->pull();
  }

  /// Every triangle of body b within the radius the patch states must be in it, in body coordinates.
  void expectComplete(const FingerPatch& patch, const BodyPatch& part) {
    const auto b = static_cast<std::size_t>(part.body);
    const TriMesh& mesh = *world_.meshes[b].haptic;
    const Pose& X_BG = world_.scene.bodies[b].haptic->X_BG;
    std::int32_t previous = -1;
    std::vector<bool> listed(mesh.triangles.size());
    for (std::int32_t i = part.first; i < part.first + part.count; ++i) {
      const PatchTriangle& t = patch.triangles[static_cast<std::size_t>(i)];
      const auto id = static_cast<std::size_t>(t.id);
      EXPECT_GT(t.id, previous);
      previous = t.id;
      listed[id] = true;
      EXPECT_EQ(t.neighbour, mesh.adjacency[id]);
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(t.v_B[k], X_BG * mesh.vertices[static_cast<std::size_t>(mesh.triangles[id][k])]);
      }
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto at = [&](std::size_t k) -> Vec3 {
        return X_BG * mesh.vertices[static_cast<std::size_t>(mesh.triangles[t][k])];
      };
      const double distance = (part.center_B - closestOnTriangle(part.center_B, at(0), at(1), at(2))).norm();
      // rounding of the two orders of transforming: a few ulp of a decimetre
      if (distance < part.radius - 1e-15) {
        EXPECT_TRUE(listed[t]) << "triangle " << t << " at " << distance;
      }
    }
  }

  World world_;
  Tick tick_{0, 0.0, 0.01};
  Device device_;
  std::unique_ptr<CollisionModule> module_;
  std::unique_ptr<Bridge<DeviceState>> bridge_;
};

const Pose kPlaced{Vec3(0.4, -0.2, 0.1), Quat(Eigen::AngleAxisd(0.9, Vec3(1, 2, -1).normalized()))};
const Pose kInBody{Vec3(0.01, 0.03, -0.02), Quat(Eigen::AngleAxisd(-0.5, Vec3(0, 1, 3).normalized()))};

// The law of the patch: what can be touched before the next patch is in it, wherever body and mesh are placed.
TEST_F(CollisionModuleTest, EveryTriangleWithinTheRadiusIsInThePatch) {
  addBody(makeSphere(0.05, 4), kPlaced, kInBody);
  const Vec3 finger = kPlaced * (kInBody * Vec3(0.0, 0.0, 0.056));
  const FingerPatch& patch = query(finger).fingers[0];
  ASSERT_EQ(patch.body_count, 1);
  ASSERT_GT(patch.triangle_count, 20);
  EXPECT_FALSE(patch.bodies[0].capped);
  EXPECT_LT((kPlaced * patch.bodies[0].center_B - finger).norm(), 1e-15);
  expectComplete(patch, patch.bodies[0]);
}

// Constant velocity, constant acceleration: the way of a finger over the horizon is inside the bound, by mechanics.
TEST_F(CollisionModuleTest, RadiusGrowsByTheWayTheFingerCanGo) {
  addBody(makeBox({0.1, 0.1, 0.1}), {});
  const double still = query({0, 0, 0.06}).fingers[0].bodies[0].radius;
  const double moving = query({0, 0, 0.06}, {0.3, 0, 0.4}).fingers[0].bodies[0].radius;
  const double horizon = 2 * 0.01 + 1 / world_.scene.rates.dynamics;
  constexpr double kFarther = 1.5;  // a patch is made half as large again as needed, so that it serves for a while
  EXPECT_NEAR(still, kFarther * (kFingertip + reach::kMargin + 0.5 * reach::kAcceleration * horizon * horizon), 1e-15);
  EXPECT_NEAR(moving - still, kFarther * 0.5 * horizon, 1e-15);
}

// A patch serves until what the finger needs is no longer in it; whatever the way, what is needed is always there.
TEST_F(CollisionModuleTest, APatchServesUntilTheFingerNeedsMore) {
  addBody(makeSphere(0.05, 4), kPlaced, kInBody);
  const double needed = kFingertip + reach::kMargin + 0.5 * reach::kAcceleration * 0.025 * 0.025;
  ASSERT_EQ(1 / world_.scene.rates.dynamics, 0.005);
  int made = 0;
  std::uint64_t serial = 0;
  for (double angle = 0; angle < 1; angle += 0.01) {  // 0.56 mm a query
    const Vec3 finger = kPlaced * (kInBody * Vec3(0.056 * std::sin(angle), 0, 0.056 * std::cos(angle)));
    const FingerPatch& patch = query(finger).fingers[0];
    if (patch.serial != serial) ++made;
    serial = patch.serial;
    ASSERT_EQ(patch.body_count, 1);
    const BodyPatch& part = patch.bodies[0];
    ASSERT_GE(part.radius, (kPlaced * part.center_B - finger).norm() + needed);
    expectComplete(patch, part);
  }
  // half the radius lasts for 0.5 needed / 0.56 mm queries
  EXPECT_NEAR(made, 100 / (0.5 * needed / 0.00056), 2);
}

// The scene may fix the radius instead, and may allow fewer triangles: the patch stays true to what it says of itself.
TEST_F(CollisionModuleTest, ObeysTheScenesMarginAndCap) {
  addBody(makeSphere(0.02, 5), {});
  world_.scene.collision = {.margin = 0.002, .max_triangles = 0};
  const double margin_only = query({0, 0, 0.028}, {0.3, 0, 0.4}).fingers[0].bodies[0].radius;
  EXPECT_NEAR(margin_only, kFingertip + 0.002, 1e-15);
  world_.scene.collision.max_triangles = 100;
  module_.reset(), bridge_.reset();
  const FingerPatch& capped = query({0, 0, 0.028}).fingers[0];
  EXPECT_EQ(capped.triangle_count, 100);
  EXPECT_TRUE(capped.bodies[0].capped);
  expectComplete(capped, capped.bodies[0]);
}

// A finger that rides on a spinning body stands still against it; one at rest beside it does not.
TEST(MotionBound, SeesTheFingerFromTheRotatingBody) {
  const Vec3 w(0, 0, 10), p(0.05, 0, 0.02);
  const double h = 0.025;
  const double riding = motionBound({p, w.cross(p), Vec3::Zero(), w}, h);
  const double resting = motionBound({p, Vec3::Zero(), Vec3::Zero(), w}, h);
  EXPECT_NEAR(riding, 0.5 * (reach::kAcceleration + 100 * p.norm()) * h * h, 1e-15);
  // true way of a point at rest in the rotating frame: chord of the arc
  EXPECT_GE(resting, 2 * 0.05 * std::sin(10 * h / 2));
}

TEST_F(CollisionModuleTest, WhatIsOutOfReachIsNotListed) {
  addBody(makeSphere(0.05, 3), {});
  EXPECT_EQ(query({0, 0, 0.2}).fingers[0].body_count, 0);
  EXPECT_EQ(query({0, 0, std::numeric_limits<double>::quiet_NaN()}).fingers[0].body_count, 0);
}

// A mesh too fine for the patch: full, counted, and complete within the smaller radius it states.
TEST_F(CollisionModuleTest, ATooFineMeshIsCappedCountedAndStillTrue) {
  addBody(makeSphere(0.02, 6), {});
  const ContactPatches& patches = query({0, 0, 0.028});
  const FingerPatch& patch = patches.fingers[0];
  EXPECT_EQ(patch.triangle_count, kMaxPatchTriangles);
  EXPECT_TRUE(patch.bodies[0].capped);
  EXPECT_EQ(patches.capped_total, 1u);
  EXPECT_GT(patch.bodies[0].radius, kFingertip);
  expectComplete(patch, patch.bodies[0]);
  EXPECT_EQ(query({0, 0, 0.028}).capped_total, 2u);
}

// The capacity belongs to the finger: two fine bodies share it by nearness, and both stay complete within their radius.
TEST_F(CollisionModuleTest, BodiesShareTheCapacityByNearness) {
  addBody(makeSphere(0.02, 5), {Vec3(0, 0, -0.029), Quat::Identity()});
  addBody(makeSphere(0.02, 5), {Vec3(0, 0, 0.0285), Quat::Identity()});
  const ContactPatches& patches = query(Vec3::Zero());
  const FingerPatch& patch = patches.fingers[0];
  ASSERT_EQ(patch.body_count, 2);
  EXPECT_EQ(patch.bodies[0].body, 1);
  EXPECT_LE(patch.triangle_count, kMaxPatchTriangles);
  for (int i = 0; i < 2; ++i) expectComplete(patch, patch.bodies[static_cast<std::size_t>(i)]);
}

TEST_F(CollisionModuleTest, OnlyTheNearestBodiesAreKept) {
  for (int i = 0; i < kMaxNearBodies + 2; ++i) {
    addBody(makeBox({0.01, 0.01, 0.01}), {Vec3(0, 0.001 * i, 0.01 + 0.0001 * i), Quat::Identity()});
  }
  const ContactPatches& patches = query(Vec3::Zero());
  EXPECT_EQ(patches.fingers[0].body_count, kMaxNearBodies);
  EXPECT_EQ(patches.capped_total, 2u);
  for (int i = 0; i < kMaxNearBodies; ++i) EXPECT_EQ(patches.fingers[0].bodies[static_cast<std::size_t>(i)].body, i);
}

// Three slots of a triple buffer, each copied to in turn while patches change one by one: every slot ends as its source was.
TEST(ContactPatches, ACopyIsWhatItsSourceWasWhateverItHeldBefore) {
  auto source = std::make_unique<ContactPatches>();
  std::array<std::unique_ptr<ContactPatches>, 3> slots;
  for (auto& slot : slots) slot = std::make_unique<ContactPatches>();
  for (std::uint64_t round = 1; round < 30; ++round) {
    source->count = 1 + static_cast<int>(round % 3);
    FingerPatch& changed = source->fingers[round % 3];
    changed.serial = round;
    changed.body_count = 1;
    changed.triangle_count = static_cast<int>(round % 7);
    changed.bodies[0] = {.body = static_cast<std::int32_t>(round), .count = changed.triangle_count};
    for (int t = 0; t < changed.triangle_count; ++t)
      changed.triangles[static_cast<std::size_t>(t)].id = static_cast<int>(100 * round) + t;
    ContactPatches& slot = *slots[round / 2 % 3];
    slot = *source;
    ASSERT_EQ(slot.count, source->count);
    for (std::size_t f = 0; f < static_cast<std::size_t>(slot.count); ++f) {
      const FingerPatch &copy = slot.fingers[f], &original = source->fingers[f];
      ASSERT_EQ(copy.serial, original.serial);
      ASSERT_EQ(copy.triangle_count, original.triangle_count);
      ASSERT_EQ(copy.bodies[0].body, original.bodies[0].body);
      for (std::size_t t = 0; t < static_cast<std::size_t>(copy.triangle_count); ++t)
        ASSERT_EQ(copy.triangles[t].id, original.triangles[t].id);
    }
  }
}

// A finger that leaves a body whose patch was full finds it gone, and finds it again when it comes back.
TEST_F(CollisionModuleTest, LeavesAFullPatchAndComesBack) {
  addBody(makeSphere(0.02, 6), {});
  world_.scene.collision = {.margin = 0, .max_triangles = 50};
  EXPECT_EQ(query({0, 0, 0.028}).fingers[0].triangle_count, 50);
  EXPECT_EQ(query({0, 0, 1.0}).fingers[0].body_count, 0);
  const FingerPatch& back = query({0, 0, 0.028}).fingers[0];
  EXPECT_EQ(back.triangle_count, 50);
  expectComplete(back, back.bodies[0]);
}

}  // namespace
}  // namespace presa
