// Force perturbation [Max1994, as printed in Basdogan and Srinivasan's chapter on haptic rendering]. With the height
// h >= 0, N the normal, d the depth, and the perturbed normal M = N - grad h + (grad h . N) N,
//   F = k ((d - K h) N + K h M) for d > K h, else F = k d M;
// in both cases the part along N is k d, and the part across it -k min(K h, d) grad h.
//
// Where d > K h that is the gradient of k (d^2 + K h^2) / 2. Nearer to the face it is not: the part across grows with
// d, the part along N does not depend on h. A finger that goes round an area of the plane (h, d) in d < K h gains k
// times the area, up to k K H^2 / 2 on a flank of height H. The conservative form lets the energy of the heights grow
// with the depth, by w from 0 at the face to 1 at the depth D, with the slope 0 at both:
//   E = k (d^2 + K h^2 w(d / D)) / 2,   F = k ((d + K h^2 w' / (2 D)) N - K h w grad h).
// With D = 2 K H the slope of the normal force is k (1 +- 3 / (4 K)): for K >= 1 it always grows with d.
#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "framework/haptics/face_height.h"
#include "framework/haptics/felt_height.h"

namespace presa {
namespace {

/// Force over the stiffness: along the normal, and across it as a multiple of the slope [m].
struct Answer {
  double along, across;
};

/// As printed.
Answer printed(double depth, double height, double gain) noexcept { return {depth, std::min(gain * height, depth)}; }

/// `full`: the depth D.
Answer conservative(double depth, double height, double gain, double full) noexcept {
  const double u = full > 0 ? std::min(1.0, depth / full) : 1;
  const double w = u * u * (3 - 2 * u), slope = full > 0 ? 6 * u * (1 - u) / full : 0;
  return {depth + 0.5 * gain * height * height * slope, gain * height * w};
}

bool isPrinted(const std::string& form) {
  if (form != "printed" && form != "conservative")
    throw std::invalid_argument("no form '" + form + "'; there are conservative and printed");
  return form == "printed";
}

class Perturbation final : public SurfaceEffect, public FeltHeight {
 public:
  explicit Perturbation(const PluginElement& element)
      : pattern_(element),
        gain_(element.number("gain")),
        full_(2 * gain_ * 2 * pattern_.amplitude()),
        printed_(isPrinted(element.text("form"))) {}

  void apply(const SurfaceInput& input, SurfaceContact& contact) noexcept override {
    if (!(contact.depth > 0)) return;
    const PatternOnFace at = pattern_.at(input);
    const double height = pattern_.amplitude() * (at.s + 1);
    const Answer answer =
        printed_ ? printed(contact.depth, height, gain_) : conservative(contact.depth, height, gain_, full_);
    const Vec3 slope = at.slope - at.slope.dot(contact.nhat) * contact.nhat;
    const Vec3 force = answer.along * contact.nhat - answer.across * slope;
    contact.depth = force.norm();
    contact.nhat = force / contact.depth;
  }
  double heightAt(const Vec3& p_T) const noexcept override { return pattern_.amplitude() * (pattern_.at(p_T).s + 1); }
  std::string what() const override {
    std::ostringstream text;
    text << "force perturbation: " << pattern_.what() << ", gain " << gain_ << (printed_ ? ", as printed" : "");
    return text.str();
  }

 private:
  FacePattern pattern_;
  double gain_, full_;  // K; D [m]
  bool printed_;
};

const SurfaceEffectPlugin kPlugin{
    .name = "perturbation",
    .create = [](const PluginElement& element, const World& world) -> std::unique_ptr<SurfaceEffect> {
      requireFlatSides(element, world);
      return std::make_unique<Perturbation>(element);
    }};

}  // namespace
}  // namespace presa

PRESA_SURFACE_EFFECT_PLUGIN(presa::kPlugin)
