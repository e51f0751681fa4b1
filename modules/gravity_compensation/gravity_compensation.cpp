#include "framework/haptics/body_effect.h"

// f = -share m g at the centre of mass, at most max_force.
namespace presa {
namespace {

class GravityCompensation final : public BodyEffect {
 public:
  explicit GravityCompensation(const PluginElement& element)
      : share_(element.number("share")), max_(element.number("max_force")) {}

  BodyEffectWrench apply(const BodyEffectInput& input) noexcept override {
    const Vec3 weight = share_ * input.mass * input.gravity_W;
    const double size = weight.norm();
    return {-(size > max_ ? max_ / size : 1) * weight, Vec3::Zero(), {}};
  }

 private:
  double share_, max_;  // [-], [N]
};

const BodyEffectPlugin kPlugin{.name = "gravity_compensation",
                               .create = [](const PluginElement& element, std::size_t) -> std::unique_ptr<BodyEffect> {
                                 return std::make_unique<GravityCompensation>(element);
                               }};

}  // namespace
}  // namespace presa

PRESA_BODY_EFFECT_PLUGIN(presa::kPlugin)
