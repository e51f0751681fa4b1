#pragma once
#include <map>
#include <numbers>
#include <sstream>

#include "framework/geometry/tangent_frame.h"
#include "tests/modules/haptics_proxy/module_fixture.h"

namespace presa::test {

struct TextureValues {
  std::string shape = "sine";
  double amplitude = 1e-4, wavelength = 1e-3, direction = 0, across = 0;
  unsigned seed = 0;
};

inline constexpr double kTurn = 2 * std::numbers::pi;
inline constexpr double kHalf = 0.05;  // of the cube [m]

/// At odds with every axis.
inline Pose oddPose() { return {Vec3(0.1, -0.2, 0.3), Quat(Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()))}; }

/// A body with the texture, without friction or damping.
inline World textured(const Shape& shape, const TextureValues& values, const Pose& X_WB) {
  World world = worldOf(shape);
  world.scene.bodies[0].X_WB = X_WB;
  const auto text = [](double number) {
    std::ostringstream out;
    out.precision(17);
    out << number;
    return out.str();
  };
  std::map<std::string, std::string> attributes{{"shape", values.shape},
                                                {"amplitude", text(values.amplitude)},
                                                {"wavelength", text(values.wavelength)},
                                                {"direction", text(values.direction)},
                                                {"across", text(values.across)},
                                                {"seed", std::to_string(values.seed)}};
  world.scene.plugin_elements = {{"texture", "texture", 0, std::move(attributes), {}, PluginKind::kSurfaceEffect}};
  return world;
}

inline World texturedCube(const TextureValues& values, const Pose& X_WB = oddPose()) {
  return textured(Box{Vec3::Constant(2 * kHalf)}, values, X_WB);
}

/// A cube whose sides are cut into eight triangles each.
inline World texturedMeshCube(const TextureValues& values, const Pose& X_WB = oddPose()) {
  World world = textured(MeshRef{}, values, X_WB);
  const TriMesh box = makeBox(Vec3::Constant(2 * kHalf));
  TriMesh cut;
  for (const TriMesh::Triangle& t : box.triangles) {
    const auto first = static_cast<std::int32_t>(cut.vertices.size());
    for (std::size_t i = 0; i < 3; ++i) cut.vertices.push_back(box.vertices[static_cast<std::size_t>(t[i])]);
    for (std::size_t i = 0; i < 3; ++i) {
      cut.vertices.push_back(
          (box.vertices[static_cast<std::size_t>(t[i])] + box.vertices[static_cast<std::size_t>(t[(i + 1) % 3])]) / 2);
    }
    for (const TriMesh::Triangle& piece : {TriMesh::Triangle{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}})
      cut.triangles.push_back({first + piece[0], first + piece[1], first + piece[2]});
  }
  world.meshes[0].haptic = std::make_shared<const TriMesh>(std::move(cut));
  return world;
}

/// One finger on one side of a cube, in the side's tangent frame T: z out of the side, x and y the place on it.
class OnSide {
 public:
  OnSide(const World& world, int side) : finger_(world) {
    const Vec3 nhat_B = (side < 3 ? 1 : -1) * Vec3::Unit(side % 3);
    X_WT_ = world.scene.bodies[0].X_WB * tangentFrame(nhat_B, kHalf * nhat_B);
  }
  /// Force at a place and a depth below the side, coordinates of T [N].
  Vec3 force(double x, double y, double depth) {
    if (!started_) finger_.tick(X_WT_ * Vec3(x, y, kR + 0.001));
    started_ = true;
    return X_WT_.q.conjugate() * finger_.tick(X_WT_ * Vec3(x, y, kR - depth)).f_H_W;
  }

 private:
  OneFinger finger_;
  Pose X_WT_;
  bool started_ = false;
};

}  // namespace presa::test
