// A contact transient: f(t) = A exp(-t / decay) sin(w t) along the normal, with A in proportion to the speed of the impact. It is rendered
// as a depth, f / stiffness, so that the dynamics gives a free body what the finger feels.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <vector>

#include "framework/haptics/rendered_frequency.h"
#include "framework/haptics/surface_effect.h"

namespace presa {
namespace {

constexpr double kSlowest = 0.01;  // a touch, not a hit [m/s]
constexpr double kLasts = 30;      // in decays: 1e-13 of the amplitude is left

class Tap final : public SurfaceEffect {
 public:
  Tap(const PluginElement& element, const Scene& scene)
      : w_(2 * std::numbers::pi * element.number("frequency")),
        decay_(element.number("decay")),
        gain_(element.number("gain")),
        max_force_(element.number("max_force")),
        tools_(scene.devices.size()) {
    requireRendered(element.number("frequency"), scene.rates);
    std::ostringstream text;
    text << "tap: rings at " << element.number("frequency") << " Hz for " << 1e3 * decay_ << " ms, " << gain_
         << " N for each m/s";
    what_ = text.str();
  }

  void apply(const SurfaceInput& input, SurfaceContact& contact) noexcept override {
    Ring& ring = tools_[input.tool];
    const double depth = input.contact.depth;  // as the renderer has it, before other effects
    const bool arrived = input.time - ring.last > 1.5 * input.period;
    if (arrived) ring.amplitude = 0;
    if (ring.arriving) {
      const double speed = (depth - ring.depth) / input.period;
      ring.amplitude = speed < kSlowest ? 0 : std::min(gain_ * speed, max_force_);
      ring.start = input.time;
    }
    ring.arriving = arrived;
    ring.depth = depth;
    ring.last = input.time;
    if (ring.amplitude == 0 || !(contact.stiffness > 0)) return;
    const double t = input.time - ring.start;
    if (t > kLasts * decay_) {
      ring.amplitude = 0;
      return;
    }
    const double force = ring.amplitude * std::exp(-t / decay_) * std::sin(w_ * t);
    contact.depth = std::max(0.0, contact.depth + force / contact.stiffness);
  }
  std::string what() const override { return what_; }

 private:
  struct Ring {
    double last = -1, start = 0,
           depth = 0;       // last tick of the contact [s], begin of the ring [s], depth in that tick [m]
    double amplitude = 0;   // [N]
    bool arriving = false;  // the last tick was the first of its contact
  };
  double w_, decay_, gain_, max_force_;  // [rad/s], [s], [N s/m], [N]
  std::vector<Ring> tools_;
  std::string what_;
};

const SurfaceEffectPlugin kPlugin{
    .name = "tap", .create = [](const PluginElement& element, const World& world) -> std::unique_ptr<SurfaceEffect> {
      return std::make_unique<Tap>(element, world.scene);
    }};

}  // namespace
}  // namespace presa

PRESA_SURFACE_EFFECT_PLUGIN(presa::kPlugin)
