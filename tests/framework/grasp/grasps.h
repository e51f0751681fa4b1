#pragma once
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "framework/core/math/random.h"
#include "framework/grasp/quality.h"

namespace presa::test {

/// Point fingers on a ball of radius 1 around its centre, each pushing to the middle from the direction given.
inline GraspSnapshot ballGrasp(const std::vector<Vec3>& from, double friction, double torsion = 0) {
  GraspSnapshot grasp;
  for (const Vec3& d : from) grasp.contacts.push_back({d.normalized(), -d.normalized(), friction, torsion, 1});
  return grasp;
}

inline GraspSnapshot pinchGrasp(double friction, double torsion = 0) {
  return ballGrasp({-Vec3::UnitX(), Vec3::UnitX()}, friction, torsion);
}

/// Fingers around the upright axis, at equal angles.
inline GraspSnapshot ringGrasp(int fingers, double friction, double torsion = 0) {
  std::vector<Vec3> from;
  for (int i = 0; i < fingers; ++i) {
    const double angle = 2 * std::numbers::pi * i / fingers;
    from.emplace_back(std::cos(angle), std::sin(angle), 0);
  }
  return ballGrasp(from, friction, torsion);
}

inline GraspSnapshot tetrahedronGrasp(double friction) {
  return ballGrasp({Vec3(1, 1, 1), Vec3(1, -1, -1), Vec3(-1, 1, -1), Vec3(-1, -1, 1)}, friction);
}

inline GraspSnapshot moved(GraspSnapshot grasp, const Pose& X) {
  grasp.centre = X * grasp.centre;
  for (GraspContact& contact : grasp.contacts) {
    contact.p = X * contact.p;
    contact.inward = X.q * contact.inward;
  }
  return grasp;
}

inline Vec3 anyUnit(RandomStream& random) {
  Vec3 v;
  do {
    v = Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  } while (v.norm() > 1 || v.norm() < 0.1);
  return v.normalized();
}

/// Fingers all over a ball, normals up to 20 degrees off the middle, some soft; centre of mass beside the middle.
inline GraspSnapshot anyGrasp(RandomStream& random, int fingers) {
  GraspSnapshot grasp;
  grasp.centre = 0.2 * anyUnit(random);
  for (int i = 0; i < fingers; ++i) {
    const Vec3 d = anyUnit(random);
    const Vec3 inward = (-d + 0.35 * anyUnit(random)).normalized();
    grasp.contacts.push_back({d, inward, random.uniform(0.2, 1.2), random.uniform(-0.2, 0.2), random.uniform(0.5, 2)});
    grasp.contacts.back().torsion = std::max(0.0, grasp.contacts.back().torsion);
  }
  return grasp;
}

}  // namespace presa::test
