#include <limits>
#include <stdexcept>

#include "framework/haptics/force_effect.h"

namespace presa {
namespace {

class Faulty final : public ForceEffect {
 public:
  explicit Faulty(const PluginElement& element) : after_(element.number("after")) {
    const std::string& fault = element.text("fault");
    if (fault == "throws") throw std::runtime_error("no such field");
    if (fault == "unknown_attribute") (void)element.number("strength");
    force_.x() = fault == "nan" ? std::numeric_limits<double>::quiet_NaN() : 1.01 * element.number("max_force");
  }
  EffectForce apply(std::size_t, const EffectInput& input) noexcept override {
    return input.time < after_ ? EffectForce{} : EffectForce{force_, Vec3::Zero()};
  }

 private:
  double after_;
  Vec3 force_ = Vec3::Zero();
};

const ForceEffectPlugin kPlugin{
    .name = "faulty", .create = [](const PluginElement& element, std::size_t) -> std::unique_ptr<ForceEffect> {
      return std::make_unique<Faulty>(element);
    }};

}  // namespace
}  // namespace presa

PRESA_FORCE_EFFECT_PLUGIN(presa::kPlugin)
