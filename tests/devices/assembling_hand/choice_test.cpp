// Choice of the next block and grasp, in small scenes with a single right answer.
#include "devices/assembling_hand/choice.h"

#include <gtest/gtest.h>

#include <cmath>

namespace presa::assembling {
namespace {

constexpr double kFingertip = 0.008, kOpening = 0.012;

Quat turn(double angle, const Vec3& axis) { return Quat(Eigen::AngleAxisd(angle, axis.normalized())); }

/// Equal boxes, of which the last is the ground; body 0 belongs to the only goal.
class Table {
 public:
  explicit Table(const Vec3& size, std::vector<Pose> poses, const Vec3& place) {
    world_.scene.materials.emplace_back().friction_dynamic = 0.6;
    world_.scene.assembly.emplace();
    world_.scene.assembly->goals.emplace_back();
    world_.scene.assembly->goals[0].bodies = {0};
    world_.scene.assembly->goals[0].X_WB.p = place;
    poses.push_back({{0, 0, -0.05}, Quat::Identity()});
    objects_.bodies.resize(poses.size());
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const bool ground = i + 1 == poses.size();
      Body& body = world_.scene.bodies.emplace_back();
      body.fixed = ground;
      body.physics = Geometry{Box{ground ? Vec3(2, 2, 0.1) : size}, {}, {}};
      objects_.bodies[i].X_WB_end = poses[i];
      world_.inertias.push_back({0.1, Vec3::Zero(), Mat3::Identity()});
    }
    world_.meshes.resize(poses.size());
  }

  Choice weigh(const Trial& before = {}, const Trial& other = {}) const {
    std::vector<Trial> trials(world_.scene.bodies.size());
    trials[0] = before;
    if (trials.size() > 2) trials[1] = other;
    return Chooser(world_, kFingertip, kOpening).weigh(objects_, 0, 0, Vec3(0, 0, 0.3), 0, trials);
  }
  Vec3 line(const Choice& choice) const { return objects_.bodies[choice.body].X_WB_end.q * choice.grasp.a_B; }
  double friction() const { return world_.scene.materials[0].friction_dynamic; }
  Surroundings surroundings() const { return Surroundings(world_); }
  const ObjectState& objects() const { return objects_; }

 private:
  World world_;
  ObjectState objects_;
};

const Vec3 kSize(0.06, 0.03, 0.04);
const Vec3 kFarAway(0.5, 0, 0.02);

TEST(Choice, AFreeBlockIsTakenAcrossItsNarrowSide) {
  const Table table(kSize, {{{0, 0, 0.02}, Quat::Identity()}}, kFarAway);
  const Choice choice = table.weigh();
  EXPECT_EQ(choice.body, 0U);
  EXPECT_FALSE(choice.only_moves);
  EXPECT_NEAR(std::abs(table.line(choice).y()), 1, 1e-12);
}

TEST(Choice, WithANeighbourInTheWayItIsTakenByTheOtherSides) {
  const Table table(kSize, {{{0, 0, 0.02}, Quat::Identity()}, {{0, 0.035, 0.02}, Quat::Identity()}}, kFarAway);
  const Choice choice = table.weigh();
  EXPECT_FALSE(choice.only_moves);
  EXPECT_NEAR(std::abs(table.line(choice).x()), 1, 1e-12);
}

TEST(Choice, WhatLiesOnItIsMovedFirst) {
  const Table table(kSize, {{{0, 0, 0.02}, Quat::Identity()}, {{0, 0, 0.06}, Quat::Identity()}}, kFarAway);
  const Choice choice = table.weigh();
  EXPECT_EQ(choice.body, 1U);
  EXPECT_TRUE(choice.only_moves);
}

TEST(Choice, WhatStandsInItsPlaceIsMovedFirst) {
  const Table table(kSize, {{{0, 0, 0.02}, Quat::Identity()}, {kFarAway, Quat::Identity()}}, kFarAway);
  EXPECT_EQ(table.weigh().body, 1U);
}

TEST(Choice, AFlatBlockOnItsHeadIsTippedOverAndTakenAsLowAsFingersGet) {
  const Table table({0.06, 0.03, 0.02}, {{{0, 0, 0.01}, turn(EIGEN_PI, Vec3::UnitX())}}, kFarAway);
  const Choice choice = table.weigh();
  EXPECT_TRUE(choice.only_moves);
  EXPECT_TRUE(choice.tips_over);
  const Vec3 p_W = table.objects().bodies[0].X_WB_end * choice.grasp.p_BC;
  EXPECT_NEAR(p_W.z(), Chooser::kOverGround * kFingertip, 1e-12);
  EXPECT_NEAR(p_W.head<2>().norm(), 0.75 * 0.03, 1e-12) << "near an edge, so that it hangs from it";
}

// The bounding box of a placed wedge overlaps the goal of the tile above it.
TEST(Choice, WhatIsPlacedIsNotMoved) {
  const Table table(kSize, {{{0, 0, 0.02}, Quat::Identity()}, {kFarAway, Quat::Identity()}}, kFarAway);
  EXPECT_EQ(table.weigh({}, {.placed = true}).body, 0U);
}

TEST(Choice, WhatWasInVainIsTriedOtherwise) {
  const Table table(kSize, {{{0, 0, 0.02}, Quat::Identity()}}, kFarAway);
  const Choice first = table.weigh();
  const Choice second = table.weigh({1, first.grasp.a_B, first.only_moves});
  EXPECT_NEAR(first.grasp.a_B.dot(second.grasp.a_B), 0, 1e-12);
}

// A plate of 6 mm under fingertips of 8 mm radius is held by its edge: the friction, 0.6 of the normal force, must also
// balance the component that presses it down.
TEST(Choice, APlateLowerThanTheFingertipsIsHeldHarder) {
  const Table flat({0.06, 0.03, 0.006}, {{{0, 0, 0.003}, Quat::Identity()}}, kFarAway);
  const Table high({0.06, 0.03, 0.04}, {{{0, 0, 0.02}, Quat::Identity()}}, kFarAway);
  const double over = (Chooser::kOverGround * kFingertip - 0.006) / kFingertip, mu = high.friction();
  EXPECT_NEAR(flat.weigh().grasp.force / high.weigh().grasp.force, mu / (mu * std::sqrt(1 - over * over) - over), 1e-9);
}

TEST(Surroundings, ABallIsFreeUntilItTouchesABox) {
  const Table table(kSize, {{{0, 0, 0.02}, turn(EIGEN_PI / 2, Vec3::UnitZ())}}, kFarAway);
  const Surroundings around = table.surroundings();
  EXPECT_EQ(around.bodyAt(table.objects(), {0.0251, 0, 0.02}, 0.01, 9), Surroundings::kNothing);
  EXPECT_EQ(around.bodyAt(table.objects(), {0.0249, 0, 0.02}, 0.01, 9), 0U);
  EXPECT_EQ(around.bodyAt(table.objects(), {0.0249, 0, 0.02}, 0.01, 0), Surroundings::kNothing) << "but that one";
}

TEST(Surroundings, ABodyIsPutALittleAwayFromItsNeighbourAndInTheMiddleOfTwo) {
  const Pose place{{0, 0, 0.02}, Quat::Identity()};
  const Pose left{{-0.0602, 0, 0.02}, Quat::Identity()}, right{{0.0602, 0, 0.02}, Quat::Identity()};
  const Pose elsewhere{kFarAway, Quat::Identity()};
  const Table one(kSize, {elsewhere, left}, place.p), two(kSize, {elsewhere, left, right}, place.p);
  EXPECT_LT((one.surroundings().awayFromNeighbours(one.objects(), 0, place) - Vec3(0.003, 0, 0)).norm(), 1e-12);
  EXPECT_LT(two.surroundings().awayFromNeighbours(two.objects(), 0, place).norm(), 1e-12);
}

TEST(Surroundings, RoomIsWhereNothingIsAndNearest) {
  const Table table(kSize, {{{0, 0, 0.02}, Quat::Identity()}, {{0.05, 0, 0.02}, Quat::Identity()}}, kFarAway);
  const auto room = table.surroundings().roomFor(table.objects(), 0, {0.05, 0, 0}, kFingertip);
  ASSERT_TRUE(room);
  const double radius = kSize.norm() / 2;
  const double away = (*room - Vec3(0.05, 0, 0)).head<2>().norm();
  EXPECT_GE(away, 2 * radius + 2.5 * kFingertip);
  EXPECT_LT(away, 2 * radius + 2.5 * kFingertip + 0.02) << "a step of the search farther at most";
}

}  // namespace
}  // namespace presa::assembling
