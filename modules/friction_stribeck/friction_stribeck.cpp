#include <algorithm>
#include <cmath>

#include "framework/haptics/friction_law.h"

// A sliding finger feels mu(v) N + B v, mu(v) = mu_d + (mu_s - mu_d) exp(-(v / v_s)^2). In mu(v), v is the speed of the
// finger: at that of the anchor, behind a spring, the falling branch would have no steady slide. Positions of a device
// are quantised, so v is smoothed. B v as in friction_viscous: the anchor moves by a fraction of the stretch beyond.
namespace presa {
namespace {

constexpr double kBorder = 1 + 1e-10;
constexpr double kSmoothing = 5e-3;  // time constant of the speed [s]

class Stribeck final : public FrictionLaw {
 public:
  explicit Stribeck(const PluginElement& element)
      : speed_(element.number("speed")), viscosity_(element.number("viscosity")) {}

  FrictionAnswer hold(const FrictionInput& input, FrictionState& state) const noexcept override {
    const double at_speed = smoothedSpeed(input, state) / speed_;
    const double mu = input.mu_dynamic + (input.mu_static - input.mu_dynamic) * std::exp(-at_speed * at_speed);
    FrictionAnswer answer;
    answer.stretch = input.stretch;
    answer.bound = input.mu_static;
    answer.bound_sliding = mu;
    const double length = input.stretch.norm(), sliding = mu * input.depth;
    // a finger that stops on the border sticks, however its stretch is rounded
    answer.slipping = length > (input.slipping ? kBorder * sliding : input.mu_static * input.depth);
    if (!answer.slipping) return answer;
    const double fraction = 1 / (1 + viscosity_ / (input.stiffness * input.period));
    const double kept = length - fraction * (length - sliding);
    answer.stretch *= kept / length;
    answer.bound_sliding = kept / input.depth;
    answer.bound = std::max(answer.bound, answer.bound_sliding);
    return answer;
  }

 private:
  static double smoothedSpeed(const FrictionInput& input, FrictionState& state) noexcept {
    Vec3& v = state.vector;
    v -= v.dot(input.nhat) * input.nhat;
    v += (1 - std::exp(-input.period / kSmoothing)) * (input.slide / input.period - v);
    return v.norm();
  }

  double speed_;      // v_s [m/s]
  double viscosity_;  // B [N s/m]
};

const FrictionLawPlugin kPlugin{.name = "friction_stribeck",
                                .create = [](const PluginElement& element) -> std::unique_ptr<FrictionLaw> {
                                  return std::make_unique<Stribeck>(element);
                                }};

}  // namespace
}  // namespace presa

PRESA_FRICTION_LAW_PLUGIN(presa::kPlugin)
