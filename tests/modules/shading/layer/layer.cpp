#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "framework/haptics/surface_effect.h"

namespace presa {
namespace {

class Layer final : public SurfaceEffect {
 public:
  explicit Layer(const PluginElement& element)
      : softness_(element.number("softness")), height_(element.number("height")) {
    if (element.text("fault") == "throws") throw std::runtime_error("no such layer");
    if (element.text("fault") == "nan") softness_ = std::numeric_limits<double>::quiet_NaN();
  }
  void apply(const SurfaceInput& input, SurfaceContact& contact) noexcept override {
    contact.stiffness *= softness_;
    if (height_ == 0) return;
    const double phase = kWaves * input.touched_B().z();
    const Vec3 z_A = input.X_BA(input.contact.body).q.conjugate() * Vec3::UnitZ();
    const Vec3 tilted =
        contact.nhat - height_ * kWaves * std::cos(phase) * (z_A - z_A.dot(contact.nhat) * contact.nhat);
    contact.depth = std::max(0.0, contact.depth + height_ * std::sin(phase)) * tilted.norm();
    contact.nhat = tilted.normalized();
  }
  std::string what() const override { return "a layer for tests"; }

 private:
  static constexpr double kWaves = 2 * std::numbers::pi / 0.004;  // [rad/m]
  double softness_, height_;
};

const SurfaceEffectPlugin kPlugin{
    .name = "test_layer", .create = [](const PluginElement& element, const World&) -> std::unique_ptr<SurfaceEffect> {
      return std::make_unique<Layer>(element);
    }};

}  // namespace
}  // namespace presa

PRESA_SURFACE_EFFECT_PLUGIN(presa::kPlugin)
