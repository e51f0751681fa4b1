#include "framework/haptics/friction_law.h"

namespace presa {
namespace {

class Cone final : public FrictionLaw {
 public:
  FrictionAnswer hold(const FrictionInput& input, FrictionState&) const noexcept override {
    FrictionAnswer answer;
    answer.bound = input.mu_static;
    answer.bound_sliding = input.mu_dynamic;
    const double length = input.stretch.norm();
    // a finger that stops on the border sticks, however its stretch is rounded
    answer.slipping = length > (input.slipping ? kBorder * input.mu_dynamic : input.mu_static) * input.depth;
    answer.stretch = input.stretch;
    if (answer.slipping) answer.stretch *= input.mu_dynamic * input.depth / length;
    return answer;
  }

 private:
  static constexpr double kBorder = 1 + 1e-10;
};

const FrictionLawPlugin kPlugin{
    .name = "friction_cone",
    .create = [](const PluginElement&) -> std::unique_ptr<FrictionLaw> { return std::make_unique<Cone>(); }};

}  // namespace
}  // namespace presa

PRESA_FRICTION_LAW_PLUGIN(presa::kPlugin)
