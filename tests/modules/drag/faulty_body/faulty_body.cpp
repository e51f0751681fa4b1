#include <limits>
#include <stdexcept>

#include "framework/haptics/body_effect.h"

namespace presa {
namespace {

class FaultyBody final : public BodyEffect {
 public:
  explicit FaultyBody(const PluginElement& element)
      : after_(element.number("after")), max_(element.number("max_force")), fault_(element.text("fault")) {
    if (fault_ == "throws") throw std::runtime_error("no such field");
    if (fault_ == "nan") wrench_.f_W.x() = std::numeric_limits<double>::quiet_NaN();
    if (fault_ == "too_much") wrench_.f_W.z() = 1.01 * max_;
    if (fault_ == "torque") wrench_.torque_W.z() = 1e-6;  // its bound is zero, as the element has no max_torque
    if (fault_ == "push") wrench_.f_W.x() = 0.5 * max_;
    if (fault_ == "rate") wrench_.rates.damping = -1;
  }
  BodyEffectWrench apply(const BodyEffectInput& input) noexcept override {
    if (input.time < after_) return {};
    return wrench_;
  }

 private:
  double after_, max_;
  std::string fault_;
  BodyEffectWrench wrench_;
};

const BodyEffectPlugin kPlugin{.name = "faulty_body",
                               .create = [](const PluginElement& element, std::size_t) -> std::unique_ptr<BodyEffect> {
                                 return std::make_unique<FaultyBody>(element);
                               }};

}  // namespace
}  // namespace presa

PRESA_BODY_EFFECT_PLUGIN(presa::kPlugin)
