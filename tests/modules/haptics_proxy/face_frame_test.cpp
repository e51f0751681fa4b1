// The tangent frame of the face that a fingertip touches, as surface effects get it.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "framework/haptics/renderers.h"
#include "framework/haptics/surface_effect.h"
#include "tests/modules/haptics_proxy/module_fixture.h"

namespace presa {
namespace {

using test::kR;

constexpr double kHalf = 0.05;  // of the cube [m]

/// A cube at a slant, touched by one fingertip of the god-object.
class Cube {
 public:
  Cube(bool mesh, const Pose& X_BG)
      : world_(make(mesh, X_BG)),
        renderer_(makeRenderer(world_)),
        touchables_(world_),
        near_(touchables_.meshCount()) {}

  /// Touches the cube at a point p_G of its surface, from outside along nhat_G. X_GT.
  Pose touch(const Vec3& p_G, const Vec3& nhat_G) {
    const Vec3 from = X_WG() * (p_G + 1.2 * kR * nhat_G), to = X_WG() * (p_G + 0.9 * kR * nhat_G);
    ProxyState proxy{from, from, false, false};
    const Pose X_WA;
    BoundedList<RenderedContact> own;
    for (const Vec3& p_WH : {from, to}) {
      touchables_.surround(near_, kNoBody, p_WH, 2 * kR, 0.01, 1e-3, nullptr);
      near_.setStep(0.3 * kR);
      const ProxyContact contact = renderer_->touch({0, p_WH, kR, proxy, X_WA, near_, own});
      proxy = contact.state;
      if (!contact.state.touching) continue;
      const SurfaceInput input{0, 0, 1e-3, kR, p_WH, contact, X_WA, touchables_, near_, nullptr};
      return world_.scene.bodies[0].haptic->X_BG.inverse() * input.X_BT();
    }
    ADD_FAILURE() << "no contact";
    return {};
  }

 private:
  static World make(bool mesh, const Pose& X_BG) {
    World world = test::worldOf(Box{Vec3::Constant(2 * kHalf)});
    Body& body = world.scene.bodies[0];
    body.X_WB = {Vec3(0.1, -0.2, 0.3), Quat(Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()))};
    body.haptic->X_BG = X_BG;
    if (mesh) {
      body.haptic->shape = MeshRef{};
      world.meshes[0].haptic = std::make_shared<const TriMesh>(makeBox(Vec3::Constant(2 * kHalf)));
    }
    indexHapticMeshes(world);
    return world;
  }
  Pose X_WG() const { return world_.scene.bodies[0].X_WB * world_.scene.bodies[0].haptic->X_BG; }

  World world_;
  std::unique_ptr<Renderer> renderer_;
  Touchables touchables_;
  Surroundings near_;
};

// Each side of a cube, box or mesh, has one frame, on both triangles: z is the side's normal, and the side's middle is
// the origin.
TEST(FaceFrame, IsThatOfTheSideOfACube) {
  for (const bool mesh : {false, true}) {
    Cube cube(mesh, {});
    for (int side = 0; side < 6; ++side) {
      Vec3 nhat = Vec3::Zero(), u = Vec3::Zero(), v = Vec3::Zero();
      nhat[side % 3] = side < 3 ? 1 : -1;
      u[(side + 1) % 3] = v[(side + 2) % 3] = 1;
      const Pose first = cube.touch(kHalf * nhat + 0.02 * u + 0.01 * v, nhat);
      EXPECT_NEAR((first.p - kHalf * nhat).norm(), 0, 1e-6) << mesh << side;
      EXPECT_NEAR((first.q * Vec3::UnitZ() - nhat).norm(), 0, 1e-6) << mesh << side;
      EXPECT_NEAR((first.q * Vec3::UnitX())[side % 3 == 0 ? 1 : 0], 1, 1e-6) << mesh << side;
      for (const auto& [at_u, at_v] : {std::pair{-0.02, 0.01}, {0.0, -0.03}, {0.049, 0.049}}) {
        const Pose other = cube.touch(kHalf * nhat + at_u * u + at_v * v, nhat);
        EXPECT_NEAR(first.q.angularDistance(other.q), 0, 1e-6) << mesh << side << at_u;
        EXPECT_NEAR((first.p - other.p).norm(), 0, 1e-6) << mesh << side << at_u;
      }
    }
  }
}

// A fingertip that rolls over the edge of a box stays on a side until it leans more to the other.
TEST(FaceFrame, OfAnEdgeIsThatOfTheSideItLeansTo) {
  Cube cube(false, {});
  const Vec3 edge(kHalf, 0, kHalf);
  for (const double angle : {0.2, 0.7, 0.9, 1.4}) {
    const Pose X_GT = cube.touch(edge, {std::sin(angle), 0, std::cos(angle)});
    EXPECT_NEAR((X_GT.q * Vec3::UnitZ() - (angle < std::numbers::pi / 4 ? Vec3::UnitZ() : Vec3::UnitX())).norm(), 0,
                1e-6);
  }
}

// Where the geometry is turned in the body, x follows the body's axis: 30 degrees from the geometry's, across z.
TEST(FaceFrame, FollowsTheBodysAxes) {
  const double angle = std::numbers::pi / 6;
  const Pose X_BG{Vec3(0.01, 0.02, 0), Quat(Eigen::AngleAxisd(angle, Vec3::UnitZ()))};
  for (const bool mesh : {false, true}) {
    const Pose X_GT = Cube(mesh, X_BG).touch({0.01, 0.02, kHalf}, Vec3::UnitZ());
    EXPECT_NEAR((X_GT.q * Vec3::UnitX() - Vec3(std::cos(angle), -std::sin(angle), 0)).norm(), 0, 1e-6);
    EXPECT_NEAR((X_BG * X_GT.p - Vec3(0, 0, kHalf)).norm(), 0, 1e-6);  // below the body's origin
  }
}

}  // namespace
}  // namespace presa
