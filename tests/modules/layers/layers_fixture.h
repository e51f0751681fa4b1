#pragma once
#include <algorithm>
#include <map>
#include <sstream>

#include "framework/geometry/tangent_frame.h"
#include "tests/modules/haptics_proxy/module_fixture.h"

namespace presa::test {

struct LayerValues {
  double skin = 0.2, core = 1, thickness = 0.002, transition = 0.001;
};

inline constexpr double kSide = 0.1;  // of the cube [m]
/// Of the proxy, which ends within 1e-6 of the fingertip's radius [m].
inline constexpr double kPlace = 1e-6 * kR;

/// Stiffness of the material at a depth, from the manifest's sentences [N/m].
inline double stiffnessAt(double depth, const LayerValues& values) {
  const double share = (depth - values.thickness) / values.transition;
  return kStiffness * (values.skin + (values.core - values.skin) * std::clamp(share, 0.0, 1.0));
}

/// Integral over the depth, by the trapezoidal rule between the ends of the layers, where the stiffness is linear:
/// exact to rounding [N].
inline double forceAt(double depth, const LayerValues& values) {
  const double ends[] = {0, std::min(depth, values.thickness), std::min(depth, values.thickness + values.transition),
                         depth};
  double sum = 0;
  for (int i = 0; i < 3; ++i)
    sum += 0.5 * (stiffnessAt(ends[i], values) + stiffnessAt(ends[i + 1], values)) * (ends[i + 1] - ends[i]);
  return sum;
}

inline PluginElement elementOf(const std::string& name, const std::map<std::string, double>& numbers) {
  PluginElement element{name, name, 0, {}, {}, PluginKind::kSurfaceEffect};
  for (const auto& [key, value] : numbers) {
    std::ostringstream text;
    text.precision(17);
    text << value;
    element.attributes[key] = text.str();
  }
  return element;
}

/// A cube with layers, at odds with every axis.
inline World layeredCube(const LayerValues& values, double mu_static = 0, double mu_dynamic = 0) {
  World world = worldOf(Box{Vec3::Constant(kSide)});
  world.scene.bodies[0].X_WB = {Vec3(0.1, -0.2, 0.3), Quat(Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()))};
  world.scene.materials[0].friction_static = mu_static;
  world.scene.materials[0].friction_dynamic = mu_dynamic;
  world.scene.plugin_elements = {elementOf("layers", {{"skin", values.skin},
                                                      {"core", values.core},
                                                      {"thickness", values.thickness},
                                                      {"transition", values.transition}})};
  return world;
}

/// One finger on the side z of the cube, in the side's tangent frame T.
class OnLayers {
 public:
  explicit OnLayers(const World& world) : finger_(world) {
    const Vec3 nhat_B = Vec3::UnitZ();
    X_WT_ = world.scene.bodies[0].X_WB * tangentFrame(nhat_B, 0.5 * kSide * nhat_B);
  }
  /// The contact at a place and a depth below the side. The finger comes down at the first place.
  const FingerContact& at(double x, double y, double depth) {
    if (!started_) finger_.tick(X_WT_ * Vec3(x, y, kR + 0.001));
    started_ = true;
    const FingerContact& contact = finger_.tick(X_WT_ * Vec3(x, y, kR - depth));
    slips_ = contact.mode == ContactMode::kSlip;
    return contact;
  }
  /// Whether it slipped in the last tick.
  bool slips() const { return slips_; }
  /// The force there, coordinates of T [N].
  Vec3 force(double x, double y, double depth) { return X_WT_.q.conjugate() * at(x, y, depth).f_H_W; }

 private:
  OneFinger finger_;
  Pose X_WT_;
  bool started_ = false, slips_ = false;
};

}  // namespace presa::test
