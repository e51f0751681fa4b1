// f(t) = min(amplitude, k d) sin(2 pi frequency t) on top of the spring's k d, rendered as a depth, so that the dynamics gives a free body
// what the finger feels. A burst has whole periods: it begins and ends at zero.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "framework/haptics/rendered_frequency.h"
#include "framework/haptics/surface_effect.h"

namespace presa {
namespace {

class Vibration final : public SurfaceEffect {
 public:
  Vibration(const PluginElement& element, const Scene& scene)
      : frequency_(element.number("frequency")), amplitude_(element.number("amplitude")), off_(element.number("off")) {
    requireRendered(frequency_, scene.rates);
    on_ = std::max(1.0, std::round(element.number("on") * frequency_)) / frequency_;
    std::ostringstream text;
    text << "vibration: " << amplitude_ << " N at " << frequency_ << " Hz";
    if (off_ > 0) text << ", " << on_ << " s of every " << on_ + off_ << " s";
    what_ = text.str();
  }

  void apply(const SurfaceInput& input, SurfaceContact& contact) noexcept override {
    if (!(contact.stiffness > 0)) return;
    const double t = std::fmod(input.time, on_ + off_);
    if (t >= on_) return;
    const double swing = std::min(amplitude_ / contact.stiffness, contact.depth);
    contact.depth += swing * std::sin(2 * std::numbers::pi * frequency_ * t);
  }
  std::string what() const override { return what_; }

 private:
  double frequency_, amplitude_, on_ = 0, off_;  // [Hz], [N], [s], [s]
  std::string what_;
};

const SurfaceEffectPlugin kPlugin{
    .name = "vibration",
    .create = [](const PluginElement& element, const World& world) -> std::unique_ptr<SurfaceEffect> {
      return std::make_unique<Vibration>(element, world.scene);
    }};

}  // namespace
}  // namespace presa

PRESA_SURFACE_EFFECT_PLUGIN(presa::kPlugin)
