// Many points at once against one at a time.
#include "framework/geometry/field_sweep.h"

#include <gtest/gtest.h>

#include <vector>

#include "framework/core/math/random.h"

namespace presa::field_sweep_test {
namespace {

constexpr double kVoxel = 0.001;

double box(const Vec3& p) {
  const Vec3 q = p.cwiseAbs() - Vec3(0.02, 0.015, 0.01);
  return q.cwiseMax(0).norm() + std::min(q.maxCoeff(), 0.0);
}

DistanceField field() {
  return *DistanceField::build([](const Vec3& p, double) { return box(p); },
                               {Vec3(-0.02, -0.015, -0.01), Vec3(0.02, 0.015, 0.01)}, {.voxel = kVoxel});
}

// In the band, between its blocks, and outside of the grid, whose side is about 50 voxels.
Vec3 somewhere(RandomStream& random) {
  return {random.uniform(-8, 60), random.uniform(-8, 60), random.uniform(-8, 40)};
}

TEST(FieldSweep, GivesTheBitsOfTheFieldsOwnQueries) {
  const DistanceField one = field();
  RandomStream random(1, "sweep");
  FieldSweep sweep(one);
  for (int round = 0; round < 2000; ++round) {
    std::vector<Vec3> places(1 + static_cast<std::size_t>(round) % FieldSweep::kMax);
    sweep.clear();
    for (Vec3& p : places) {
      p = somewhere(random);
      sweep.add(p.x(), p.y(), p.z());
    }
    sweep.lookUpSlopes();
    ASSERT_EQ(sweep.count(), places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Vec3& p = places[i];
      ASSERT_EQ(sweep.distance[i], one.inVoxels(p.x(), p.y(), p.z())) << p.transpose();
      ASSERT_EQ(Eigen::Vector3f(sweep.slope[0][i], sweep.slope[1][i], sweep.slope[2][i]),
                one.slopeInVoxels(p.x(), p.y(), p.z()))
          << p.transpose();
    }
  }
}

// Rounding: three products and sums of numbers up to the grid's side of 64 voxels, half an ulp of 4e-6 each, and a slope
// of up to sqrt(3) where the distance has a ridge.
TEST(FieldSweep, PlacesPointsInSinglePrecision) {
  const DistanceField one = field();
  RandomStream random(2, "sweep");
  FieldSweep sweep(one);
  for (int round = 0; round < 2000; ++round) {
    const Mat3 turn = Eigen::AngleAxisd(random.uniform(0, 3), Vec3(1, 2, 3).normalized()).toRotationMatrix() / kVoxel;
    const Vec3 shift(20, 25, 15);
    std::vector<Eigen::Vector3f> points(1 + static_cast<std::size_t>(round) % FieldSweep::kMax);
    for (Eigen::Vector3f& p : points) p = (kVoxel * (somewhere(random) - shift)).cast<float>();
    sweep.place(turn.cast<float>(), shift.cast<float>(), points);
    sweep.lookUp();
    ASSERT_EQ(sweep.count(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec3 p = turn * points[i].cast<double>() + shift;
      for (std::size_t a = 0; a < 3; ++a)
        ASSERT_NEAR(static_cast<double>(sweep.placed[a][i]), p[static_cast<Eigen::Index>(a)], 3e-5);
      const float x = sweep.placed[0][i], y = sweep.placed[1][i], z = sweep.placed[2][i];
      ASSERT_EQ(sweep.distance[i],
                one.inVoxels(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)));
    }
    for (std::size_t i = points.size(); i % 4 != 0; ++i) ASSERT_EQ(sweep.distance[i], 0);
  }
}

}  // namespace
}  // namespace presa::field_sweep_test
