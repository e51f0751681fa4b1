#include <algorithm>
#include <cmath>

#include "framework/haptics/friction_law.h"

// z' = v - sigma |v| z / Fc. While the finger slides by d in a straight line, z tends to z_s = (Fc / sigma) d / |d|:
//   z(d) = z_s + (z(0) - z_s) exp(-sigma |d| / Fc)
// whatever the speed. The force on the finger is -sigma z, and |z| <= Fc / sigma.
namespace presa {
namespace {

class Dahl final : public FrictionLaw {
 public:
  explicit Dahl(const PluginElement& element) : sigma_(element.number("stiffness")) {}

  FrictionAnswer hold(const FrictionInput& input, FrictionState& state) const noexcept override {
    const double longest =
        input.mu_dynamic * input.stiffness * input.depth / sigma_;  // bristle at the Coulomb force [m]
    Vec3& z = state.vector;
    z -= z.dot(input.nhat) * input.nhat;
    const double way = input.slide.norm();
    if (!(longest > 0)) {
      z.setZero();
    } else if (way > 0) {
      const Vec3 z_s = longest / way * input.slide;
      z = z_s + std::exp(-way / longest) * (z - z_s);
    }
    // the normal force may have fallen since the last tick
    const double length = z.norm();
    if (length > longest) z *= longest / length;
    FrictionAnswer answer;
    answer.stretch = -sigma_ / input.stiffness * z;
    answer.slipping = length >= kSlipping * longest;
    answer.bound = answer.bound_sliding = input.mu_dynamic;
    answer.ratio = sigma_ / input.stiffness;
    return answer;
  }

 private:
  static constexpr double kSlipping = 0.99;  // share of the Coulomb force from which the contact counts as slipping
  double sigma_;                             // [N/m]
};

const FrictionLawPlugin kPlugin{.name = "friction_dahl",
                                .create = [](const PluginElement& element) -> std::unique_ptr<FrictionLaw> {
                                  return std::make_unique<Dahl>(element);
                                }};

}  // namespace
}  // namespace presa

PRESA_FRICTION_LAW_PLUGIN(presa::kPlugin)
