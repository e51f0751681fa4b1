// A finger that goes round and comes back has neither gained nor lost energy.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/modules/texture/texture_fixture.h"

namespace presa {
namespace {

using test::kTurn, test::OnSide, test::TextureValues;

constexpr double kLength = 0.024;  // of a loop, about [m]
/// Share of the work that the place of the proxy leaves open: 1e-6 of the radius, over the depth of 1 mm.
constexpr double kFloor = 8e-6;

/// Place on the side and depth, for a share of the loop.
using Loop = std::function<Vec3(double)>;

struct Work {
  double net = 0, moved = 0;  ///< sum of the work, and of its magnitude [J]
  void add(const Vec3& force, const Vec3& way) {
    net += force.dot(way);
    moved += std::abs(force.dot(way));
  }
};

/// Work of the force on the finger, by the trapezoidal rule. Each side's loop starts at another part of a step, so that
/// the places where the contact begins and ends fall anywhere in a step.
Work workOver(const World& world, int side, const Loop& loop, int steps) {
  OnSide finger(world, side);
  const auto force_at = [&](const Vec3& p) {
    const Vec3 f = finger.force(p.x(), p.y(), p.z());
    return Vec3(f.x(), f.y(), -f.z());  // the depth grows against z
  };
  Work work;
  const auto at = [&](int i) { return loop(std::fmod((i + side / 6.0) / steps, 1)); };
  Vec3 p = at(0), f = force_at(p);
  for (int i = 1; i <= steps; ++i) {
    const Vec3 next = at(i), force = force_at(next);
    work.add(0.5 * (f + force), next - p);
    p = next;
    f = force;
  }
  return work;
}

Vec3 circle(double share) { return {0.004 * std::cos(kTurn * share), 0.004 * std::sin(kTurn * share), 0.0015}; }

/// 8 mm by 4 mm, turned by 20 degrees.
Vec3 rectangle(double share) {
  const double way = share * kLength;
  const Vec3 p = way < 0.008   ? Vec3(way, 0, 0)
                 : way < 0.012 ? Vec3(0.008, way - 0.008, 0)
                 : way < 0.02  ? Vec3(0.02 - way, 0.004, 0)
                               : Vec3(0, kLength - way, 0);
  return Eigen::AngleAxisd(0.35, Vec3::UnitZ()) * p + Vec3(0.001, -0.002, 0.001);
}

/// Comes down at one place and leaves at another: between -0.5 mm (off the face) and 1 mm.
Vec3 touchAndGo(double share) {
  const Vec3 p = circle(share);
  return {p.x(), p.y(), 0.00025 + 0.00075 * std::sin(kTurn * share)};
}

// Net work over moved work. The trapezoidal rule errs by step^2 / 12 times the second derivative of the force, which is
// (2 pi / wavelength)^2 times the force; the hills of noise are wider than those of a sine. Halving the step leaves a
// quarter of the error, down to what the place of the proxy gives.
struct NamedLoop {
  const char* name;
  Vec3 (*at)(double share);
};

class ClosedLoop : public testing::TestWithParam<std::tuple<std::string, double, NamedLoop>> {};

TEST_P(ClosedLoop, GainsNoEnergy) {
  const auto& [shape, wavelength, loop] = GetParam();
  double coarse = 0, fine = 0;
  for (const bool mesh : {false, true}) {
    const TextureValues texture{.shape = shape,
                                .amplitude = 0.1 * wavelength,
                                .wavelength = wavelength,
                                .direction = 25,
                                .across = shape == "sine" ? 0 : 1.7 * wavelength};
    const World world = mesh ? test::texturedMeshCube(texture) : test::texturedCube(texture);
    for (int side = 0; side < 6; ++side) {
      for (const int per_wave : {25, 50}) {
        const int steps = static_cast<int>(per_wave * kLength / wavelength);
        const Work work = workOver(world, side, loop.at, steps);
        const double error = std::abs(work.net) / work.moved;
        EXPECT_GT(work.moved, 1e-7) << side;
        EXPECT_LT(error, std::pow(kTurn / per_wave, 2) / 12) << mesh << side << ' ' << per_wave;
        (per_wave == 25 ? coarse : fine) += error;
      }
    }
  }
  EXPECT_LT(fine, std::max(coarse / 3, 12 * kFloor));
}

std::string nameOfLoop(const testing::TestParamInfo<ClosedLoop::ParamType>& of) {
  const auto& [shape, wavelength, loop] = of.param;
  return shape + "_" + std::to_string(std::lround(1e6 * wavelength)) + "um_" + loop.name;
}

INSTANTIATE_TEST_SUITE_P(Textures, ClosedLoop,
                         testing::Combine(testing::Values("sine", "grid", "noise"), testing::Values(1e-3, 2.7e-3),
                                          testing::Values(NamedLoop{"circle", circle},
                                                          NamedLoop{"rectangle", rectangle},
                                                          NamedLoop{"touch_and_go", touchAndGo})),
                         nameOfLoop);

/// Net work of a loop over the edge between the sides z and x of a cube at W: from 5 mm before the edge until the
/// finger leans by `lean` [rad] over it, along the edge, back, and along the side to the start.
Work workRoundEdge(bool mesh, const std::string& shape, double lean, double step) {
  constexpr double kDepth = 1e-3, kAway = test::kR - kDepth, kSide = 0.005;
  const TextureValues texture{.shape = shape, .direction = 30};
  test::OneFinger finger(mesh ? test::texturedMeshCube(texture, {}) : test::texturedCube(texture, {}));
  const auto at = [&](double way, double y) {
    const double angle = std::max(0.0, way - kSide) / kAway;
    return Vec3(test::kHalf + std::min(0.0, way - kSide) + kAway * std::sin(angle), y,
                test::kHalf + kAway * std::cos(angle));
  };
  const double over = kSide + kAway * lean, along = 1.3e-3, length = 2 * (over + along);
  const auto loop = [&](double way) {
    if (way < over) return at(way, 0);
    if (way < over + along) return at(over, way - over);
    return way < 2 * over + along ? at(2 * over + along - way, along) : at(0, length - way);
  };
  finger.tick(loop(0) + Vec3(0, 0, 2 * kDepth));
  Vec3 p = loop(0), f = finger.tick(p).f_H_W;
  Work work;
  const int steps = static_cast<int>(length / step);
  for (int i = 1; i <= steps; ++i) {
    const Vec3 next = loop(length * (i % steps) / steps), force = finger.tick(next).f_H_W;
    work.add(0.5 * (f + force), next - p);
    p = next;
    f = force;
  }
  return work;
}

// The slope across ends at the edge, where the touched point stays. Each of the two crossings errs by half a step times
// the tangential force that ends there, k d times a slope of 1 at most.
TEST(LoopOverAnEdge, GainsNoEnergyWhileItLeansToOneSide) {
  for (const std::string shape : {"sine", "grid", "noise"}) {
    for (const auto& [mesh, step] : {std::pair(false, 2e-5), {false, 5e-6}, {true, 2e-5}, {true, 5e-6}}) {
      const Work work = workRoundEdge(mesh, shape, 0.7, step);
      EXPECT_LT(std::abs(work.net), test::kStiffness * 1e-3 * step) << shape << ' ' << mesh << ' ' << step;
      EXPECT_GT(work.moved, 5e-4) << shape;
    }
  }
}

// Round the edge the height jumps from that of one side to that of the other, by two amplitudes at most, twice.
TEST(LoopOverAnEdge, GainsAtMostTheJumpsOfTheHeight) {
  for (const std::string shape : {"sine", "grid", "noise"}) {
    for (const bool mesh : {false, true}) {
      const Work work = workRoundEdge(mesh, shape, 1.5, 5e-6);
      EXPECT_LT(std::abs(work.net), test::kStiffness * 1e-3 * (4 * 1e-4 + 5e-6)) << shape << ' ' << mesh;
    }
  }
}

}  // namespace
}  // namespace presa
