#include <algorithm>

#include "framework/haptics/force_effect.h"

// Potential V = stiffness (1 - a . b) of the tool's axis a and the body's axis b: the couple is stiffness a x b, zero where
// they agree, and it creates no energy. Damping takes energy from the turning of a. Where their sum exceeds max_torque,
// both are scaled down.
namespace presa {
namespace {

class Align final : public ForceEffect {
 public:
  explicit Align(const PluginElement& element)
      : a_T_(element.vector3("tool_axis").normalized()),
        b_B_(element.vector3("axis").normalized()),
        stiffness_(element.number("stiffness")),
        damping_(element.number("damping")),
        max_torque_(element.number("max_torque")) {}

  EffectForce apply(std::size_t, const EffectInput& input) noexcept override {
    if (!input.oriented) return {};
    const Vec3 a = input.q_WT * a_T_, b = input.X_WB.q * b_B_;
    const Vec3 couple = stiffness_ * a.cross(b) - damping_ * (input.w_WT - a * a.dot(input.w_WT));
    const double size = couple.norm();
    return {.couple_T_W = size > max_torque_ ? Vec3(couple * (max_torque_ / size)) : couple};
  }

 private:
  Vec3 a_T_, b_B_;
  double stiffness_, damping_, max_torque_;  // [N m/rad], [N m s/rad], [N m]
};

const ForceEffectPlugin kPlugin{
    .name = "align", .create = [](const PluginElement& element, std::size_t) -> std::unique_ptr<ForceEffect> {
      return std::make_unique<Align>(element);
    }};

}  // namespace
}  // namespace presa

PRESA_FORCE_EFFECT_PLUGIN(presa::kPlugin)
