#include "framework/haptics/friction_law.h"

// The finger is attached to a point A of the surface, l aside: F_T = k_T l. It sticks up to mu_s N, and slides with mu_d N.
// The membrane yields sideways, so that the proxy moves along with the finger by 1 - k_T / k of l.
namespace presa {
namespace {

class Membrane final : public FrictionLaw {
 public:
  explicit Membrane(const PluginElement& element) : stiffness_(element.number("stiffness")) {}

  FrictionAnswer hold(const FrictionInput& input, FrictionState& state) const noexcept override {
    Vec3& l = state.vector;  // finger to A
    l -= input.slide;
    l -= l.dot(input.nhat) * input.nhat;
    FrictionAnswer answer;
    answer.ratio = stiffness_ / input.stiffness;
    answer.bound = input.mu_static;
    answer.bound_sliding = input.mu_dynamic;
    const double force = answer.ratio * l.norm();  // over k, like the depth
    // a finger that stops on the border sticks, however its stretch is rounded
    answer.slipping = force > (input.slipping ? kBorder * input.mu_dynamic : input.mu_static) * input.depth;
    if (answer.slipping) l *= input.mu_dynamic * input.depth / force;
    answer.stretch = answer.ratio * l;
    return answer;
  }

 private:
  static constexpr double kBorder = 1 + 1e-10;
  double stiffness_;  // k_T [N/m]
};

const FrictionLawPlugin kPlugin{.name = "friction_membrane",
                                .create = [](const PluginElement& element) -> std::unique_ptr<FrictionLaw> {
                                  return std::make_unique<Membrane>(element);
                                }};

}  // namespace
}  // namespace presa

PRESA_FRICTION_LAW_PLUGIN(presa::kPlugin)
