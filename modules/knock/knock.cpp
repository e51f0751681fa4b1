// A contact transient of two bodies that hit each other: f(t) = A exp(-t / decay) sin(w t) along the normal of the
// fingertip's contact, with A in proportion to the speed of the impact. Rings of several hits add up.
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <sstream>
#include <vector>

#include "framework/haptics/material_pair.h"
#include "framework/haptics/rendered_frequency.h"
#include "framework/haptics/surface_effect.h"

namespace presa {
namespace {

constexpr double kSilent = 1e-9;  // amplitude that no device renders [N]

class Knock final : public SurfaceEffect {
 public:
  Knock(const PluginElement& element, const World& world)
      : scene_(world.scene),
        body_(element.body),
        pair_(element, world.scene),
        rate_(-1 / element.number("decay"), 2 * std::numbers::pi * element.number("frequency")),
        gain_(element.number("gain")),
        max_force_(element.number("max_force")),
        tools_(world.scene.devices.size()) {
    requireRendered(element.number("frequency"), world.scene.rates);
    std::ostringstream text;
    text << "knock: " << element.text("a") << " on " << element.text("b") << " rings at " << element.number("frequency")
         << " Hz for " << 1e3 * element.number("decay") << " ms, " << gain_ << " N for each m/s";
    what_ = text.str();
  }

  void apply(const SurfaceInput& input, SurfaceContact& contact) noexcept override {
    if (input.hits == nullptr) return;
    Ring& ring = tools_[input.tool];
    if (input.time - ring.last > 1.5 * input.period) ring = {.next = input.hits->count()};  // the fingertip arrives
    ring.last = input.time;
    ring.wave *= std::exp(rate_ * input.period);
    input.hits->read(ring.next, [&](const BodyHit& hit) {
      if (hit.time > input.time) return false;  // the dynamics is ahead of the haptic thread
      if (hit.otherThan(body_) != kNoBody && pair_.holds(hit, scene_))
        ring.wave += gain_ * hit.speed * std::exp(rate_ * (input.time - hit.time));
      return true;
    });
    const double amplitude = std::abs(ring.wave);
    if (amplitude < kSilent || !(contact.stiffness > 0)) return;
    if (amplitude > max_force_) ring.wave *= max_force_ / amplitude;
    // as a depth, so that the dynamics gives a free body what the finger feels
    contact.depth = std::max(0.0, contact.depth + ring.wave.imag() / contact.stiffness);
  }
  std::string what() const override { return what_; }

 private:
  /// Of one tool: the rings that it feels are the imaginary part of one decaying, turning number.
  struct Ring {
    double last = -1;                 // last tick of the contact [s]
    std::uint64_t next = 0;           // first hit that was not heard
    std::complex<double> wave = 0.0;  // [N]
  };
  const Scene& scene_;
  const std::int32_t body_;
  const MaterialPair pair_;
  const std::complex<double> rate_;  // [1/s]
  const double gain_, max_force_;    // [N s/m], [N]
  std::vector<Ring> tools_;
  std::string what_;
};

const SurfaceEffectPlugin kPlugin{
    .name = "knock", .create = [](const PluginElement& element, const World& world) -> std::unique_ptr<SurfaceEffect> {
      return std::make_unique<Knock>(element, world);
    }};

}  // namespace
}  // namespace presa

PRESA_SURFACE_EFFECT_PLUGIN(presa::kPlugin)
