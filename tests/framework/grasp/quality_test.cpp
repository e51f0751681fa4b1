// Epsilon against closed forms, and laws that hold for every grasp.
#include "framework/grasp/quality.h"

#include <gtest/gtest.h>

#include "tests/framework/grasp/grasps.h"
#include "tests/support/effort.h"

namespace presa::test {
namespace {

/// Both bounds hold, and they meet.
void expectBounds(const ProvenBounds& bounds, double exact) {
  // a hull's facets and supports are a few hundred roundings of numbers near 1
  EXPECT_LE(bounds.at_least, exact * (1 + 1e-9));
  EXPECT_GE(bounds.at_most, exact * (1 - 1e-9));
  EXPECT_TRUE(bounds.met()) << bounds.at_least << " … " << bounds.at_most;
}

/// An independent oracle: each cone has many edges and is tried edge by edge; polygons are inside by 1 - cos(pi /
/// edges).
constexpr int kEdges = 720;
double supportByEdges(const GraspSnapshot& grasp, GripBound bound, const Vec6& u) {
  double most = 0, sum = 0;
  for (const GraspContact& contact : grasp.contacts) {
    const Vec3 t1 = contact.inward.unitOrthogonal(), t2 = contact.inward.cross(t1);
    double best = 0;
    for (int i = 0; i < kEdges; ++i) {
      const double angle = 2 * std::numbers::pi * i / kEdges;
      const Vec3 f = contact.inward + contact.friction * (std::cos(angle) * t1 + std::sin(angle) * t2);
      const Vec3 torque = (contact.p - grasp.centre).cross(f);
      for (const double twist : {-1.0, 1.0}) {
        const Vec3 all = torque + twist * contact.torsion * contact.friction * contact.inward;
        best = std::max(best, u.head<3>().dot(f) + u.tail<3>().dot(all) / grasp.length);
      }
    }
    most = std::max(most, best);
    sum += contact.max_normal * best;
  }
  return bound == GripBound::kSum ? most : sum;
}

Vec6 anyDirection(RandomStream& random) {
  Vec6 u;
  for (Eigen::Index i = 0; i < 6; ++i) u[i] = random.normal();
  return u.normalized();
}

/// Lowest support that a search finds: the best of random directions, then of random steps from it, ever shorter.
double lowestSupport(const GraspSnapshot& grasp, GripBound bound, RandomStream& random) {
  Vec6 best = anyDirection(random);
  double lowest = supportByEdges(grasp, bound, best);
  const auto look = [&](const Vec6& u) {
    const double support = supportByEdges(grasp, bound, u);
    if (support >= lowest) return;
    lowest = support;
    best = u;
  };
  for (int k = 0; k < 200; ++k) look(anyDirection(random));
  for (double step = 0.3; step > 0.003; step *= 0.7) {
    for (int k = 0; k < 20; ++k) look((best + step * anyDirection(random)).normalized());
  }
  return lowest;
}

// The body moves so that finger 1 stays where it is on its face and finger 2 slides: x + mu p and -x + mu q are equal
// at p = 0, x = mu q / 2, with x^2 + (p^2 + q^2) / 2 = 1 for fingers at the length from the centre.
TEST(Quality, OfAPinchWithoutTheTurnAboutItsLine) {
  for (const double mu : {0.1, 0.4, 0.8, 1.2}) {
    expectBounds(graspQuality(pinchGrasp(mu), GripBound::kSum).within_span, mu / std::sqrt(2 + mu * mu));
    // fingers of their own bound: finger 1 does no work at all, x = mu q
    expectBounds(graspQuality(pinchGrasp(mu), GripBound::kEach).within_span, mu / std::sqrt(0.5 + mu * mu));
  }
}

// Soft fingers bear mu r about the line and no more. Where each finger has a bound of its own, a motion towards one
// finger takes the work of the other away: 2 s / sqrt(1 + s^2), s = mu r / length.
TEST(Quality, OfASoftPinchIsItsTorsion) {
  for (const double radius : {0.01, 0.1, 0.2}) {
    const double mu = 0.8, s = mu * radius;
    const GraspQuality sum = graspQuality(pinchGrasp(mu, radius), GripBound::kSum);
    EXPECT_EQ(sum.closure, GraspClosure::kFull);
    expectBounds(sum.epsilon, s);
    EXPECT_GT(std::abs(sum.weakest[3]), 0.95);
    expectBounds(graspQuality(pinchGrasp(mu, radius), GripBound::kEach).epsilon, 2 * s / std::sqrt(1 + s * s));
  }
}

// Without friction the wrenches are forces in the plane: L1 a triangle of corners at 1, inradius 1/2; L-infinity the
// sum of three segments, a regular hexagon of side 1.
TEST(Quality, OfThreeFingersInAPlaneWithoutFriction) {
  expectBounds(graspQuality(ringGrasp(3, 0), GripBound::kSum).within_span, 0.5);
  expectBounds(graspQuality(ringGrasp(3, 0), GripBound::kEach).within_span, std::sqrt(3) / 2);
}

// With friction: a body that moves by -a along the line to one finger and turns by b about it, a^2 + b^2 = 1, moves
// against that finger with a, and at the two others with -a / 2 along the normal and sqrt(3) / 2 across. At a = mu /
// sqrt(3) all three do as much work.
TEST(Quality, OfThreeFingersInAPlaneIsAtMostWhatOneMotionAllows) {
  for (const double mu : {0.1, 0.3, 0.8, 1.2}) {
    const ProvenBounds epsilon = graspQuality(ringGrasp(3, mu), GripBound::kSum).epsilon;
    EXPECT_TRUE(epsilon.met());
    EXPECT_GT(epsilon.at_least, 0);
    EXPECT_LE(epsilon.at_least, mu / std::sqrt(3) * (1 + 1e-9)) << mu;
  }
  // less friction has a weaker motion; from here on there is none
  for (const double mu : {0.6, 0.8, 1.2})
    expectBounds(graspQuality(ringGrasp(3, mu), GripBound::kSum).epsilon, mu / std::sqrt(3));
}

// L1: a regular tetrahedron of corners at 1, inradius 1/3. L-infinity: the sum of four segments is a rhombic
// dodecahedron; along a normal (1, 0, 0) two of the four fingers push with 1 / sqrt(3) each, along (1, 1, 0) / sqrt(2)
// one with sqrt(2 / 3).
TEST(Quality, OfATetrahedronWithoutFriction) {
  expectBounds(graspQuality(tetrahedronGrasp(0), GripBound::kSum).within_span, 1.0 / 3);
  expectBounds(graspQuality(tetrahedronGrasp(0), GripBound::kEach).within_span, std::sqrt(2.0 / 3));
}

// For any grasp: no direction supports less than the lower bound, and the weakest one supports the upper bound, as an
// oracle finds that tries the edges of polyhedral cones.
TEST(Quality, BoundsHoldAndMeetForAnyGrasp) {
  // a polygon's part of the friction that is left out, of five fingers of at most 2 N, friction 1.2, 1.2 from the
  // centre
  const double coarse = (1 - std::cos(std::numbers::pi / kEdges)) * 5 * 2 * 1.2 * (1 + 1.2);
  RandomStream random(11, "quality");
  int full = 0;
  for (int i = 0; i < unlessSanitized(40, 12); ++i) {
    const GraspSnapshot grasp = anyGrasp(random, 2 + i % 4);
    const GripBound bound = i % 2 == 0 ? GripBound::kSum : GripBound::kEach;
    const GraspQuality quality = graspQuality(grasp, bound);
    if (quality.closure == GraspClosure::kNone) {
      EXPECT_LT(supportByEdges(grasp, bound, -quality.weakest), 1e-6) << i;
      continue;
    }
    if (quality.closure != GraspClosure::kFull) continue;
    ++full;
    EXPECT_TRUE(quality.epsilon.met()) << i << ' ' << quality.epsilon.at_least << ' ' << quality.epsilon.at_most;
    EXPECT_LE(quality.epsilon.at_least, quality.epsilon.at_most * (1 + 1e-9)) << i;
    const double weakest = supportByEdges(grasp, bound, -quality.weakest);
    EXPECT_NEAR(weakest, quality.epsilon.at_most, coarse) << i;
    EXPECT_GE(lowestSupport(grasp, bound, random), quality.epsilon.at_least - coarse) << i;
  }
  EXPECT_GT(full, unlessSanitized(10, 2));
}

/// Two results for what is the same grasp: the exact value is in both intervals.
void expectSame(const GraspQuality& a, const GraspQuality& b) {
  EXPECT_EQ(a.closure, b.closure);
  EXPECT_LE(a.within_span.at_least, b.within_span.at_most * (1 + 1e-9));
  EXPECT_LE(b.within_span.at_least, a.within_span.at_most * (1 + 1e-9));
}

TEST(Quality, DependsNeitherOnTheFrameNorOnTheUnitOfLength) {
  RandomStream random(13, "frames");
  for (int i = 0; i < 20; ++i) {
    const GraspSnapshot grasp = anyGrasp(random, 2 + i % 3);
    const GraspQuality quality = graspQuality(grasp, GripBound::kSum);
    const Pose X{3 * anyUnit(random), Quat(Eigen::AngleAxisd(random.uniform(0, 3), anyUnit(random)))};
    expectSame(quality, graspQuality(moved(grasp, X), GripBound::kSum));
    GraspSnapshot in_mm = grasp;
    in_mm.centre *= 1000;
    in_mm.length *= 1000;
    for (GraspContact& contact : in_mm.contacts) {
      contact.p *= 1000;
      contact.torsion *= 1000;
    }
    expectSame(quality, graspQuality(in_mm, GripBound::kSum));
  }
}

// Another finger adds wrenches and takes none away, since it may let go, while centre and length stay the same.
TEST(Quality, IsNeverLoweredByAnotherFinger) {
  RandomStream random(17, "fingers");
  for (int i = 0; i < 20; ++i) {
    GraspSnapshot grasp = anyGrasp(random, 3);
    for (const GripBound bound : {GripBound::kSum, GripBound::kEach}) {
      const GraspQuality before = graspQuality(grasp, bound);
      GraspSnapshot more = grasp;
      more.contacts.push_back(anyGrasp(random, 1).contacts[0]);
      EXPECT_GE(graspQuality(more, bound).epsilon.at_most, before.epsilon.at_least * (1 - 1e-9)) << i;
    }
  }
}

// I = m a^2 / 6 for a cube.
TEST(GyrationLength, IsHalfTheEdgeOfACube) {
  const double mass = 0.2, edge = 0.07;
  EXPECT_NEAR(gyrationLength(mass, mass * edge * edge / 6 * Mat3::Identity()), edge / 2, 1e-15);
}

}  // namespace
}  // namespace presa::test
