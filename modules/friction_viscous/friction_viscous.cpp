#include <algorithm>

#include "framework/haptics/friction_law.h"

// The anchor slides against Coulomb's force and a viscous one: k s = mu_d N + B v, v the speed of the anchor. One tick,
// implicit: the anchor moves by the fraction a of the stretch beyond the cone, a = 1 / (1 + B / (k T)). At a constant
// speed the stretch beyond the cone is v T (1 - a) / a = B v / k, whatever the period T. The spring k is in series with
// the viscosity: no B makes a tick unstable.
namespace presa {
namespace {

class Viscous final : public FrictionLaw {
 public:
  explicit Viscous(const PluginElement& element) : viscosity_(element.number("damping")) {}

  FrictionAnswer hold(const FrictionInput& input, FrictionState&) const noexcept override {
    FrictionAnswer answer;
    answer.stretch = input.stretch;
    answer.bound = input.mu_static;
    answer.bound_sliding = input.mu_dynamic;
    const double length = input.stretch.norm(), sliding = input.mu_dynamic * input.depth;
    answer.slipping = length > (input.slipping ? sliding : input.mu_static * input.depth);
    if (!answer.slipping) return answer;
    const double fraction = 1 / (1 + viscosity_ / (input.stiffness * input.period));
    const double kept = length - fraction * (length - sliding);
    answer.stretch *= kept / length;
    answer.bound = std::max(answer.bound, kept / input.depth);
    answer.bound_sliding = kept / input.depth;
    return answer;
  }

 private:
  double viscosity_;  // [N s/m]
};

const FrictionLawPlugin kPlugin{.name = "friction_viscous",
                                .create = [](const PluginElement& element) -> std::unique_ptr<FrictionLaw> {
                                  return std::make_unique<Viscous>(element);
                                }};

}  // namespace
}  // namespace presa

PRESA_FRICTION_LAW_PLUGIN(presa::kPlugin)
