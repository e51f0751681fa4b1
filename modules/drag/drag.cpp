#include "framework/haptics/body_effect.h"

// Force on a body with the velocity u relative to the medium: f = -(b + c |u|) u, at most max_force. Its slope -df/du has
// the eigenvalues b + 2 c |u| along u and b + c |u| across; at the bound 0 and max_force / |u|.
namespace presa {
namespace {

/// A resistance against u that does not exceed `max`, and its largest slope.
struct Resistance {
  Resistance(const Vec3& u, double b, double c, double max) {
    const double speed = u.norm(), full = b + c * speed;
    const bool bounded = full * speed > max;
    slope = bounded ? max / speed : b + 2 * c * speed;
    value = (bounded ? -slope : -full) * u;
  }
  Vec3 value;
  double slope;
};

class Drag final : public BodyEffect {
 public:
  explicit Drag(const PluginElement& element)
      : flow_(element.vector3("flow")),
        linear_(element.number("linear")),
        quadratic_(element.number("quadratic")),
        turning_(element.number("turning")),
        max_force_(element.number("max_force")),
        max_torque_(element.number("max_torque")) {}

  BodyEffectWrench apply(const BodyEffectInput& input) noexcept override {
    const Resistance move(input.v_WCm - flow_, linear_, quadratic_, max_force_);
    const Resistance turn(input.w_WB, turning_, 0, max_torque_);
    return {move.value, turn.value, {.damping = move.slope, .turn_damping = turn.slope}};
  }

 private:
  Vec3 flow_;                            // [m/s]
  double linear_, quadratic_, turning_;  // [N s/m], [N s^2/m^2], [N m s]
  double max_force_, max_torque_;        // [N], [N m]
};

const BodyEffectPlugin kPlugin{.name = "drag",
                               .create = [](const PluginElement& element, std::size_t) -> std::unique_ptr<BodyEffect> {
                                 return std::make_unique<Drag>(element);
                               }};

}  // namespace
}  // namespace presa

PRESA_BODY_EFFECT_PLUGIN(presa::kPlugin)
