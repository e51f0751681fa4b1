// A constant force has a potential only if it acts everywhere. A viscous force may have any coefficient c(p) >= 0: it takes
// energy wherever it acts.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "framework/haptics/bounded_damping.h"
#include "framework/haptics/force_effect.h"

namespace presa {
namespace {

double smoothStep(double u) noexcept { return u * u * (3 - 2 * u); }

class ForceField final : public ForceEffect {
 public:
  explicit ForceField(const PluginElement& element)
      : max_force_(element.number("max_force")),
        viscosity_(element.number("viscosity")),
        edge_(element.number("edge")),
        force_(element.vector3("force")),
        middle_(element.vector3("pos")),
        half_(element.vector3("size") / 2) {
    if (force_.norm() > max_force_) throw std::invalid_argument("force is longer than max_force");
    if (half_.minCoeff() < 0) throw std::invalid_argument("size is negative");
  }

  EffectForce apply(std::size_t, const EffectInput& input) noexcept override {
    const Vec3 damper = -viscosity_ * shareAt(input.p_WT) * input.v_WT;
    return {withDamping(force_, damper, max_force_), input.p_WT};
  }

 private:
  /// Of the viscosity: 1 in the medium, 0 outside.
  double shareAt(const Vec3& p_W) const noexcept {
    double share = 1;
    for (int i = 0; i < 3; ++i) {
      if (half_[i] > 0) share *= smoothStep(std::clamp((half_[i] - std::abs(p_W[i] - middle_[i])) / edge_, 0.0, 1.0));
    }
    return share;
  }
  double max_force_, viscosity_, edge_;  // [N], [N s/m], [m]
  Vec3 force_, middle_, half_;           // [N], [m], [m]
};

const ForceEffectPlugin kPlugin{
    .name = "force_field", .create = [](const PluginElement& element, std::size_t) -> std::unique_ptr<ForceEffect> {
      return std::make_unique<ForceField>(element);
    }};

}  // namespace
}  // namespace presa

PRESA_FORCE_EFFECT_PLUGIN(presa::kPlugin)
