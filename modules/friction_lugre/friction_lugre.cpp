#include <algorithm>
#include <cmath>

#include "framework/haptics/friction_law.h"

// z' = v - sigma_0 |v| z / g(v), g(v) = N (mu_d + (mu_s - mu_d) exp(-(v / v_s)^2)), force against the slide
// sigma_0 z + sigma_1 z' + sigma_2 v [Canudas1995]. Exact step for a constant velocity:
//   z(T) = z_s + (z(0) - z_s) exp(-sigma_0 |v| T / g), z_s = g v / (|v| sigma_0).
namespace presa {
namespace {

class LuGre final : public FrictionLaw {
 public:
  explicit LuGre(const PluginElement& element)
      : sigma_(element.number("stiffness")),
        speed_(element.number("speed")),
        damping_(element.number("damping")),
        viscosity_(element.number("viscosity")) {}

  FrictionAnswer hold(const FrictionInput& input, FrictionState& state) const noexcept override {
    const double normal = input.stiffness * input.depth, way = input.slide.norm(), speed = way / input.period;
    const double at_speed = speed / speed_;
    const double g =
        normal * (input.mu_dynamic + (input.mu_static - input.mu_dynamic) * std::exp(-at_speed * at_speed));
    Vec3& z = state.vector;
    z -= z.dot(input.nhat) * input.nhat;
    const Vec3 v = input.slide / input.period;
    Vec3 rate = v;  // z' at the end of the tick
    if (!(g > 0)) {
      z.setZero();
      rate.setZero();
    } else if (way > 0) {
      const double fade = sigma_ * way / g;
      const Vec3 z_s = g / (way * sigma_) * input.slide;
      z = z_s + std::exp(-fade) * (z - z_s);
      rate -= fade / input.period * z;
    }
    // the normal force may have fallen since the last tick
    const double longest = input.mu_static * normal / sigma_, length = z.norm();
    if (length > longest) z *= longest / length;
    FrictionAnswer answer;
    answer.damped = -(damping_ * rate + viscosity_ * v) / input.stiffness;
    answer.stretch = answer.damped - sigma_ / input.stiffness * z;
    answer.slipping = way > 0 && length * sigma_ >= kSlipping * g;
    const double now = answer.stretch.norm() / input.depth;
    answer.bound = answer.slipping ? now : std::max(input.mu_static, now);
    answer.bound_sliding = answer.slipping ? now : input.mu_dynamic;
    answer.ratio = sigma_ / input.stiffness;
    answer.damping = damping_ + viscosity_;
    return answer;
  }

 private:
  static constexpr double kSlipping = 0.99;  // share of g from which the contact counts as slipping
  double sigma_;                             // [N/m]
  double speed_;                             // [m/s]
  double damping_, viscosity_;               // [N s/m]
};

const FrictionLawPlugin kPlugin{.name = "friction_lugre",
                                .create = [](const PluginElement& element) -> std::unique_ptr<FrictionLaw> {
                                  return std::make_unique<LuGre>(element);
                                }};

}  // namespace
}  // namespace presa

PRESA_FRICTION_LAW_PLUGIN(presa::kPlugin)
