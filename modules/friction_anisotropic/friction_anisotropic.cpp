#include <cmath>
#include <stdexcept>

#include "framework/geometry/tangent_frame.h"
#include "framework/haptics/friction_law.h"

// The stretch lies in an ellipse, semi-axes mu d along the grain and across * mu d across it. A stretch outside moves to
// the nearest point s of it: the anchor then slides along the ellipse's normal at s, which is the direction in which the
// force resists most (maximum dissipation). Nearest point of (x / a)^2 + (y / b)^2 = 1 to (x_0, y_0):
//   x = a^2 x_0 / (a^2 + t), y = b^2 y_0 / (b^2 + t), t > 0.
namespace presa {
namespace {

using Vec2 = Eigen::Vector2d;

/// Newton in t from 0, where the sum is convex and falls: from below, without passing the root.
Vec2 nearestOnEllipse(const Vec2& axes, const Vec2& outside) noexcept {
  constexpr int kMaxSteps = 30;
  constexpr double kResolution = 1e-12;
  const Eigen::Array2d squares = axes.array().square();
  Eigen::Array2d x = outside.array();
  double t = 0;
  for (int i = 0; i < kMaxSteps; ++i) {
    const Eigen::Array2d reach = squares + t;
    const Eigen::Array2d parts = (axes.array() * outside.array() / reach).square();
    x = squares * outside.array() / reach;
    const double excess = parts.sum() - 1;
    if (!(excess > kResolution)) break;
    t += excess / (2 * (parts / reach).sum());
  }
  return x;
}

class Anisotropic final : public FrictionLaw {
 public:
  explicit Anisotropic(const PluginElement& element)
      : grain_B_(element.vector3("grain")), across_(element.number("across")) {
    if (!(grain_B_.norm() > 0)) throw std::invalid_argument("grain must not be 0 0 0");
    grain_B_.normalize();
  }

  FrictionAnswer hold(const FrictionInput& input, FrictionState&) const noexcept override {
    const Vec3 along = grainIn(input), beside = input.nhat.cross(along);
    const Vec2 stretch(input.stretch.dot(along), input.stretch.dot(beside)), shape(1, across_);
    const double length = stretch.norm();
    const double used = stretch.cwiseQuotient(shape).norm();  // coefficient along the grain that holds it, times depth
    FrictionAnswer answer;
    answer.stretch = input.stretch;
    // a finger that stops on the border sticks, however its stretch is rounded
    answer.slipping = used > (input.slipping ? kBorder * input.mu_dynamic : input.mu_static) * input.depth;
    if (answer.slipping && input.mu_dynamic > 0) {
      const Vec2 left = nearestOnEllipse(input.mu_dynamic * input.depth * shape, stretch);
      answer.stretch = left.x() * along + left.y() * beside;
      answer.bound = answer.bound_sliding = left.norm() / input.depth;
    } else if (answer.slipping) {
      answer.stretch.setZero();
    } else {
      const double in_this_direction = used > 0 ? length / used : 1;
      answer.bound = in_this_direction * input.mu_static;
      answer.bound_sliding = in_this_direction * input.mu_dynamic;
    }
    return answer;
  }

 private:
  static constexpr double kBorder = 1 + 1e-10;  // beyond what nearestOnEllipse leaves
  /// Unit vector in the plane of contact, frame A.
  Vec3 grainIn(const FrictionInput& input) const noexcept {
    constexpr double kAcross = 0.1;  // a grain nearer to the normal has no direction in the face
    Vec3 grain = input.q_BA.conjugate() * grain_B_;
    grain -= grain.dot(input.nhat) * input.nhat;
    const double length = grain.norm();
    if (length > kAcross) return grain / length;
    return input.q_BA.conjugate() * (tangentFrame(input.q_BA * input.nhat, Vec3::Zero()).q * Vec3::UnitX());
  }

  Vec3 grain_B_;
  double across_;
};

const FrictionLawPlugin kPlugin{.name = "friction_anisotropic",
                                .create = [](const PluginElement& element) -> std::unique_ptr<FrictionLaw> {
                                  return std::make_unique<Anisotropic>(element);
                                }};

}  // namespace
}  // namespace presa

PRESA_FRICTION_LAW_PLUGIN(presa::kPlugin)
