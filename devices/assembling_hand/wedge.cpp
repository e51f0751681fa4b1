#include "devices/assembling_hand/wedge.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace presa::assembling {
namespace {

constexpr double kMaxAskew = 0.25, kAskewStep = 0.05;  // angle of the line to level across the top [rad]
// height of the line above the centre of mass [m]
constexpr double kLowest = 0.002, kHighest = 0.02, kWedgeStep = 0.0015;
constexpr double kAskewCosts = 0.02;  // [m/rad]
constexpr double kOfCone = 0.7;       // usable share of the friction angle

/// Intersection of a line with the surface of a convex mesh.
struct Exit {
  double along = std::numeric_limits<double>::infinity();  ///< distance from the start of the line [m]
  double steep = 0;                                        ///< cosine between the line and the face normal
};

Exit exitOf(const TriMesh& mesh, const Pose& X_BG, const Vec3& p_B, const Vec3& a_B) {
  Exit exit;
  for (const auto& triangle : mesh.triangles) {
    const auto corner = [&](std::size_t k) { return X_BG * mesh.vertices[static_cast<std::size_t>(triangle[k])]; };
    const Vec3 a = corner(0), outward = (corner(1) - a).cross(corner(2) - a).normalized();
    const double slope = outward.dot(a_B);
    if (slope <= 0) continue;
    const double along = outward.dot(a - p_B) / slope;
    if (along < exit.along) exit = {along, slope};
  }
  return exit;
}

}  // namespace

std::optional<Grasp> graspOfLyingMesh(const World& world, std::size_t i, const Pose& X_WB, const Vec3& up_B,
                                      double yaw) {
  const TriMesh* mesh = world.meshes[i].physics.get();
  const Body& body = world.scene.bodies[i];
  if (!std::holds_alternative<MeshRef>(body.physics->shape) || mesh == nullptr) return std::nullopt;
  const Vec3 level_W = Vec3::UnitZ().cross(X_WB.q * up_B).normalized();
  const double friction = std::max(0.1, world.scene.materialOf(body).friction_dynamic);
  const double min_steep = std::cos(kOfCone * std::atan(friction));
  std::optional<Grasp> best;
  double best_score = 0;
  for (double askew = -kMaxAskew; askew <= kMaxAskew + kAskewStep / 2; askew += kAskewStep) {
    const Vec3 a_W = Quat(Eigen::AngleAxisd(askew, Vec3::UnitZ())) * level_W;
    for (double above = kLowest; above < kHighest; above += kWedgeStep) {
      const double score = above - kAskewCosts * std::abs(askew);
      if (best && score <= best_score) continue;
      Grasp grasp = graspAlong(world, i, X_WB, Vec3::Zero(), a_W, yaw);
      const Vec3 p_B = world.inertias[i].p_BCm + above * up_B;
      const Exit on = exitOf(*mesh, body.physics->X_BG, p_B, grasp.a_B),
                 back = exitOf(*mesh, body.physics->X_BG, p_B, -grasp.a_B);
      if (on.along < 0 || back.along < 0 || std::min(on.steep, back.steep) < min_steep) continue;
      grasp.p_BC = p_B + (on.along - back.along) / 2 * grasp.a_B;
      grasp.half = (on.along + back.along) / 2;
      best = grasp;
      best_score = score;
    }
  }
  return best;
}

}  // namespace presa::assembling
