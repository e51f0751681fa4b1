#include <cmath>

#include "framework/haptics/force_effect.h"

// The force is central and depends on the distance d from the pole alone, so it has a potential and creates no energy:
//   f(d) = max_force / c * u (1 - u^2)^2,  u = d / range,  0 <= u <= 1
// It is linear at the pole and goes to zero smoothly at the range. Its maximum lies at u = 1 / sqrt(5), where
// u (1 - u^2)^2 = 16 / (25 sqrt(5)) = c.
namespace presa {
namespace {

class Magnet final : public ForceEffect {
 public:
  explicit Magnet(const PluginElement& element)
      : p_BM_(element.vector3("pos")), range_(element.number("range")), scale_(element.number("max_force") / kPeak) {}

  EffectForce apply(std::size_t, const EffectInput& input) noexcept override {
    const Vec3 p_WM = input.X_WB * p_BM_;
    const Vec3 u = (p_WM - input.p_WT) / range_;
    const double rest = 1 - u.squaredNorm();
    return rest > 0 ? EffectForce{scale_ * rest * rest * u, p_WM} : EffectForce{};
  }

 private:
  static constexpr double kPeak = 0.28621670111997307;  // 16 / (25 sqrt(5))
  Vec3 p_BM_;                                           // pole in B [m]
  double range_, scale_;                                // [m], [N]
};

const ForceEffectPlugin kPlugin{
    .name = "magnet", .create = [](const PluginElement& element, std::size_t) -> std::unique_ptr<ForceEffect> {
      return std::make_unique<Magnet>(element);
    }};

}  // namespace
}  // namespace presa

PRESA_FORCE_EFFECT_PLUGIN(presa::kPlugin)
