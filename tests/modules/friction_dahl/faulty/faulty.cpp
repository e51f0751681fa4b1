#include <limits>
#include <stdexcept>

#include "framework/haptics/friction_law.h"

namespace presa {
namespace {

class Faulty final : public FrictionLaw {
 public:
  explicit Faulty(const PluginElement& element) {
    const std::string& fault = element.text("fault");
    if (fault == "throws") throw std::runtime_error("no such surface");
    factor_ = fault == "nan" ? std::numeric_limits<double>::quiet_NaN() : 1.01;
  }
  FrictionAnswer hold(const FrictionInput& input, FrictionState&) const noexcept override {
    FrictionAnswer answer;
    answer.bound = input.mu_static;
    answer.stretch = Vec3(factor_ * input.mu_static * input.depth, 0, 0);
    return answer;
  }

 private:
  double factor_ = 0;
};

const FrictionLawPlugin kPlugin{.name = "faulty_friction",
                                .create = [](const PluginElement& element) -> std::unique_ptr<FrictionLaw> {
                                  return std::make_unique<Faulty>(element);
                                }};

}  // namespace
}  // namespace presa

PRESA_FRICTION_LAW_PLUGIN(presa::kPlugin)
