// Proxy position and force against exact answers, for finer and finer meshes.
//
// The exact answer: let K be the convex solid under the finger, h the HIP, r the fingertip's radius. The fingertip's
// centre may be anywhere at distance >= r from K, and a god-object is a local minimum of its distance to h.
// - h outside K, d = dist(h, K) < r at the point q: the distance to K grows by at most 1 m per metre, and does so along
//   (h - q) / d. So q + r (h - q) / d, at the distance r - d, is the only minimum.
// - h inside K: from a point over an edge or a corner the distance to h decreases towards one of the adjacent facets.
//   The minima are
//   points over facets: h + (s + r) n for each facet (unit normal n, h at depth s below its plane) that contains h + s
//   n. Near an edge
//   both facets have one; the path decides, and both are exact.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "framework/geometry/rotation_between.h"
#include "tests/modules/haptics_proxy/surface/support/finger_rig.h"
#include "tests/modules/haptics_proxy/surface/support/mesh_oracle.h"
#include "tests/modules/haptics_proxy/surface/support/shapes.h"

namespace presa::test {
namespace {

constexpr double kStiffness = 2000, kPress = 1e-3, kFar = 0.25, kRadii[] = {0, 0.1e-3, 1e-3, 8e-3, 15e-3};

/// Sensitivity of the exact answer to rounding [m]. With the HIP almost at the solid, the fingertip's centre can move
/// round it at almost the same distance: the result is how far it moves for a change of 1e-14 m.
double illPosed(const MeshOracle& mesh, bool inside, const Vec3& h, double r) {
  if (inside) return 0;
  return r * std::sqrt(2e-14 / std::max(1e-13, mesh.nearest(h).distance));
}

/// The exact answer nearest to the actual proxy.
Vec3 exactAnswer(const MeshOracle& mesh, bool inside, const Vec3& h, double r, const Vec3& proxy) {
  if (!inside) {
    const MeshOracle::Nearest nearest = mesh.nearest(h);
    if (nearest.distance >= r) return h;
    if (nearest.distance < 1e-12)
      return nearest.point + r * mesh.normal(nearest.triangle);  // on the surface, by rounding
    return nearest.point + r / nearest.distance * (h - nearest.point);
  }
  static std::vector<std::int32_t> found;
  mesh.near(mesh.nearest(h).point, 3 * kPress, found);
  Vec3 best = Vec3::Constant(1e300);
  for (const std::int32_t t : found) {
    const std::array<Vec3, 3> corner = mesh.corners(t);
    const Vec3 n = mesh.normal(t), foot = h + (corner[0] - h).dot(n) * n;
    // 1 nm: a foot on the edge between two facets belongs to both
    if ((nearestOnTriangle(foot, corner[0], corner[1], corner[2]) - foot).norm() > 1e-9) continue;
    if (const Vec3 answer = foot + r * n; (answer - proxy).norm() < (best - proxy).norm()) best = answer;
  }
  return best;
}

struct Place {
  Vec3 on, normal, along;  ///< a point of the ideal surface, its outward normal, a direction to slide
};

struct Errors {
  double proxy = 0;       ///< distance from the exact answer [m]
  double force = 0;       ///< normal force minus k times the exact depth [N]
  double tangential = 0;  ///< tangential force beyond that caused by the facets [N]
  double ideal = 0;       ///< force along the ideal surface [N]
  double chatter = 0;     ///< force step while the finger is still [N]
  double step = 0;        ///< force step while it slides at 0.1 m/s, beyond that of the exact answer [N]
  std::uint32_t lost = 0, popped = 0;
};

void keepWorst(double& worst, double value) { worst = std::isnan(value) ? 1e300 : std::max(worst, value); }

/// Moves the finger to a free place on a path far from the body, approaching radially.
void comeTo(FingerRig& rig, const Vec3& to) {
  const Vec3 from = rig.at(), out = from.norm() > 0 ? Vec3(from.normalized()) : Vec3(Vec3::UnitZ());
  const Quat turn = rotationBetween(out, to);
  for (int i = 0; i <= 8; ++i) rig.place(kFar * (Quat::Identity().slerp(i / 8.0, turn) * out));
  rig.place(to);
}

/// Down at 0.2 m/s, still for 30 ms, sliding for 50 ms. `inside`: the HIP is then inside the solid.
void touchAt(FingerRig& rig, const MeshOracle& mesh, const Place& place, Errors& errors) {
  const double r = rig.touch().radius;
  const bool inside = r < kPress;
  Vec3 h;
  Vec3 last_force = Vec3::Zero(), last_exact = Vec3::Zero();
  double last_slack = 0;
  const auto judge = [&](bool& first, bool still) {
    const FingerContact& felt = rig.tick(h);
    const Vec3 exact = exactAnswer(mesh, inside, h, r, felt.p_WP), exact_force = kStiffness * (exact - h);
    const double slack = illPosed(mesh, inside, h, r);
    keepWorst(errors.proxy, (felt.p_WP - exact).norm() - slack);
    keepWorst(errors.force, std::abs(felt.f_H_W.dot(place.normal) - exact_force.dot(place.normal)));
    const Vec3 difference = felt.f_H_W - exact_force;
    keepWorst(errors.tangential,
              (difference - difference.dot(place.normal) * place.normal).norm() - kStiffness * slack);
    if (still) keepWorst(errors.ideal, (felt.f_H_W - felt.f_H_W.dot(place.normal) * place.normal).norm());
    if (!first) {
      if (still) keepWorst(errors.chatter, (felt.f_H_W - last_force).norm());
      if (!still) {
        const double exact_step = (exact_force - last_exact).norm() + kStiffness * (slack + last_slack);
        keepWorst(errors.step, (felt.f_H_W - last_force).norm() - exact_step);
      }
    }
    first = false;
    last_force = felt.f_H_W;
    last_exact = exact_force;
    last_slack = slack;
  };
  comeTo(rig, place.on + (r + 5e-3) * place.normal);
  const std::uint32_t lost = rig.all().coverage_lost;
  for (double way = 5e-3; way > 0; way -= 0.2e-3) rig.tick(place.on + (r - kPress + way) * place.normal);
  h = place.on + (r - kPress) * place.normal;
  for (int i = 0; i < 10; ++i) rig.tick(h);
  bool first = true;
  for (int i = 0; i < 20; ++i) judge(first, true);
  first = true;
  for (int i = 0; i < 50; ++i) {
    h += 0.1e-3 * place.along;
    judge(first, false);
  }
  errors.lost += rig.all().coverage_lost - lost;
  comeTo(rig, kFar * place.normal);
}

/// A mesh and the ideal surface that it approximates.
struct Ideal {
  std::string name;
  std::shared_ptr<const TriMesh> mesh;
  std::function<Place(std::mt19937_64&)> place;
};

Vec3 randomDirection(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const double x = normal(random), y = normal(random), z = normal(random);
  return Vec3(x, y, z).normalized();
}

Place onSphere(std::mt19937_64& random) {
  const Vec3 n = randomDirection(random);
  return {0.05 * n, n, n.cross(randomDirection(random)).normalized()};
}
/// A place on the upper side, at least 20 mm from its edges.
Place onTop(std::mt19937_64& random, double height) {
  std::uniform_real_distribution<double> uniform(-0.03, 0.03), angle(0, 6.283);
  const double x = uniform(random), y = uniform(random), a = angle(random);
  return {{x, y, height}, Vec3::UnitZ(), {std::cos(a), std::sin(a), 0}};
}

std::shared_ptr<const TriMesh> share(TriMesh mesh) { return std::make_shared<const TriMesh>(std::move(mesh)); }

/// A sphere of 20 n^2 triangles; planeOf: the same number, as nearly as a square grid allows.
Ideal sphereOf(int n) { return {"sphere", share(icosphere(n, 0.05)), onSphere}; }
Ideal planeOf(int n) {
  const int m = static_cast<int>(std::lround(std::sqrt(10.0) * n));
  return {"plane", share(sheet(0.1, m)), [](std::mt19937_64& random) { return onTop(random, 0); }};
}
Ideal boxOf(int n) {
  const int m = static_cast<int>(std::lround(std::sqrt(20.0 / 12) * n));
  return {"box", share(cutBox({0.1, 0.1, 0.1}, m)), [](std::mt19937_64& random) { return onTop(random, 0.05); }};
}

Errors measure(const Ideal& ideal, const MeshOracle& oracle, double radius, bool smooth = false) {
  FingerRig rig(ideal.mesh, {.radius = radius, .stiffness = kStiffness, .smooth = smooth});
  std::mt19937_64 random(7);
  Errors errors;
  for (int i = 0; i < 8; ++i) touchAt(rig, oracle, ideal.place(random), errors);
  errors.popped = rig.all().pop_through;
  return errors;
}

void expectExact(const Ideal& ideal) {
  const MeshOracle oracle(*ideal.mesh);
  const bool finest = ideal.mesh->triangles.size() > 1'000'000;
  for (const double radius : kRadii) {
    if (finest && (radius == 1e-3 || radius == 15e-3)) continue;  // saves time: only the radius differs
    SCOPED_TRACE(testing::Message() << ideal.name << " of " << ideal.mesh->triangles.size() << " triangles, radius "
                                    << radius * 1e3 << " mm");
    const Errors errors = measure(ideal, oracle, radius);
    EXPECT_EQ(errors.lost, 0u);
    EXPECT_EQ(errors.popped, 0u);
    EXPECT_LE(errors.proxy, 1e-6);        // a thousandth of the depth
    EXPECT_LE(errors.force, 0.002);       // the same times the stiffness
    EXPECT_LE(errors.tangential, 0.005);  // a quarter of a percent of the force: imperceptible
    EXPECT_LE(errors.chatter, 1e-12);     // rounding
    EXPECT_LE(errors.step, 0.004);        // two proxies, each 1 um off
  }
}

constexpr int kCoarse = 32, kFine = 128, kFinest = 256;  // 20 480, 327 680 and 1 310 720 triangles

TEST(Accuracy, OfACoarsePlane) { expectExact(planeOf(kCoarse)); }
TEST(Accuracy, OfAFinePlane) { expectExact(planeOf(kFine)); }
TEST(Accuracy, OfTheFinestPlane) { expectExact(planeOf(kFinest)); }
TEST(Accuracy, OfACoarseBox) { expectExact(boxOf(kCoarse)); }
TEST(Accuracy, OfAFineBox) { expectExact(boxOf(kFine)); }
TEST(Accuracy, OfTheFinestBox) { expectExact(boxOf(kFinest)); }
TEST(Accuracy, OfACoarseSphere) { expectExact(sphereOf(kCoarse)); }
TEST(Accuracy, OfAFineSphere) { expectExact(sphereOf(kFine)); }
TEST(Accuracy, OfTheFinestSphere) { expectExact(sphereOf(kFinest)); }

// A level surface gives the full spring force: 2 N at 1 mm and 2 N/mm, on any mesh.
TEST(Accuracy, OneMillimetreIsTwoNewtons) {
  for (const double radius : kRadii) {
    FingerRig rig(planeOf(kCoarse).mesh, {.radius = radius, .stiffness = kStiffness});
    for (int i = 0; i <= 30; ++i) rig.tick({0.0123, 0.0077, radius + 2e-3 - i * 0.1e-3});
    const FingerContact& felt = rig.tick({0.0123, 0.0077, radius - 1e-3});
    EXPECT_NEAR(felt.normal_force, 2.000, 0.002) << radius;
    EXPECT_LE(felt.tangential_force_W.norm(), 0.002) << radius;
  }
}

// With shading the facets disappear: no force along the ideal sphere. Tolerance 0.1 % of the force: vertex normals are
// means over facets of slightly different shapes. In addition the touched point differs: on a facet tilted by an angle
// it is displaced sideways by that angle times its distance from the HIP.
TEST(Accuracy, ASmoothSphereHasNoFacets) {
  for (const int n : {kCoarse, kFine}) {
    const Ideal ideal = sphereOf(n);
    const MeshOracle oracle(*ideal.mesh);
    for (const double radius : kRadii) {
      SCOPED_TRACE(testing::Message() << 20 * n * n << " triangles, radius " << radius * 1e3 << " mm");
      const Errors errors = measure(ideal, oracle, radius, true);
      const double aside = std::max(0.0, radius - kPress) * facetAngle(n);
      EXPECT_LE(errors.ideal, std::max(0.002, kStiffness * kPress * aside / 0.05));
      EXPECT_LE(errors.chatter, 1e-12);
    }
  }
}

}  // namespace
}  // namespace presa::test
