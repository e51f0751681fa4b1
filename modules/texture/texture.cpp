// The stored energy of a fingertip in a textured face is E = k max(0, d + h)^2 / 2: d is its depth below the face, k
// the stiffness, and h(x, y) <= 0 the height over the face at the touched point. The force is its negative gradient,
//   f = k (d + h) (nhat - grad h),
// because a motion along nhat lowers d, and one across it moves the touched point alike; on an edge, only along the
// edge. With h <= 0 it is zero where the contact with the face begins: no loop gains energy, nor one that leaves the
// face at another place than it came.
#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "framework/haptics/surface_effect.h"
#include "modules/texture/pattern.h"

namespace presa {
namespace {

constexpr double kEdge = 1e-4;   // sine of the angle between the normals of contact and face, from which it is an edge
constexpr double kMaxSlope = 1;  // the force leans by at most 45 degrees

std::string inMillimetres(double length) {
  std::ostringstream text;
  text << length * 1e3 << " mm";
  return text.str();
}

const Pattern& patternOf(const PluginElement& element) {
  const std::string& shape = element.text("shape");
  const Pattern* pattern = findPattern(shape);
  if (pattern == nullptr) throw std::invalid_argument("no shape '" + shape + "'; there are sine, grid and noise");
  return *pattern;
}

double acrossOf(const PluginElement& element, const Pattern& pattern) {
  const double across = element.number("across");
  if (across > 0 && !pattern.two_wavelengths)
    throw std::invalid_argument(std::string("shape '") + pattern.name +
                                "' has no wavelength across; grid and noise have");
  return across > 0 ? across : element.number("wavelength");
}

/// Normal of the contact before force shading.
Vec3 normalOf(const ProxyContact& contact) noexcept {
  Vec3 sum = Vec3::Zero();
  for (int i = 0; i < contact.active.count; ++i) {
    const ActiveSet::Member& member = contact.active.member[static_cast<std::size_t>(i)];
    sum += member.weight * member.nhat;
  }
  return sum.norm() > 0 ? Vec3(sum.normalized()) : contact.nhat;
}

std::uint64_t seedOf(const PluginElement& element) {
  const double seed = element.number("seed");
  if (seed != std::floor(seed)) throw std::invalid_argument("the seed must be a whole number");
  return static_cast<std::uint64_t>(seed);
}

class Texture final : public SurfaceEffect {
 public:
  explicit Texture(const PluginElement& element)
      : pattern_(patternOf(element)),
        amplitude_(element.number("amplitude")),
        wavelength_(element.number("wavelength")),
        across_(acrossOf(element, pattern_)),
        seed_(seedOf(element)) {
    const double direction = element.number("direction") * std::numbers::pi / 180;
    along_T_ = {std::cos(direction), std::sin(direction), 0};
    across_T_ = {-along_T_.y(), along_T_.x(), 0};
    const double slope = amplitude_ * std::hypot(pattern_.max_ds_du / wavelength_, pattern_.max_ds_dv / across_);
    if (slope > kMaxSlope) {
      std::ostringstream text;
      text << "its slope reaches " << slope << ", above 1; an amplitude of " << inMillimetres(amplitude_ / slope)
           << " would be the largest for these wavelengths";
      throw std::invalid_argument(text.str());
    }
  }

  void apply(const SurfaceInput& input, SurfaceContact& contact) noexcept override {
    const Pose X_BT = input.X_BT();
    const Vec3 p_T = X_BT.inverseTimes(input.touched_B());
    const PatternValue at = pattern_.at(p_T.dot(along_T_) / wavelength_, p_T.dot(across_T_) / across_, seed_);
    const Vec3 slope_T = amplitude_ * (at.ds_du / wavelength_ * along_T_ + at.ds_dv / across_ * across_T_);
    const Quat q_AT = input.X_BA(input.contact.body).q.conjugate() * X_BT.q;
    Vec3 slope = q_AT * slope_T;
    // on an edge the touched point moves along the edge only
    const Vec3 edge = normalOf(input.contact).cross(q_AT * Vec3::UnitZ());
    if (edge.norm() > kEdge) slope = slope.dot(edge) / edge.squaredNorm() * edge;
    const Vec3 tilted = contact.nhat - (slope - slope.dot(contact.nhat) * contact.nhat);
    contact.depth = std::fmax(0, contact.depth + amplitude_ * (at.s - 1)) * tilted.norm();
    contact.nhat = tilted.normalized();
  }
  std::string what() const override {
    return std::string("texture: ") + pattern_.name + " of " + inMillimetres(amplitude_) + ", wavelength " +
           inMillimetres(wavelength_) +
           (pattern_.two_wavelengths ? ", across " + inMillimetres(across_) : std::string{});
  }

 private:
  const Pattern& pattern_;
  double amplitude_, wavelength_, across_;  // [m]
  std::uint64_t seed_;
  Vec3 along_T_, across_T_;  // unit vectors in the tangent frame
};

const SurfaceEffectPlugin kPlugin{
    .name = "texture",
    .create = [](const PluginElement& element, const World& world) -> std::unique_ptr<SurfaceEffect> {
      const Body& body = world.scene.bodies[static_cast<std::size_t>(element.body)];
      const Shape& shape = body.haptic->shape;
      // a curved primitive has another tangent frame at each point, so no place on it
      if (!std::holds_alternative<Box>(shape) && !std::holds_alternative<MeshRef>(shape))
        throw std::invalid_argument("body '" + body.name + "' has no flat sides; a texture needs a box or a mesh");
      return std::make_unique<Texture>(element);
    }};

}  // namespace
}  // namespace presa

PRESA_SURFACE_EFFECT_PLUGIN(presa::kPlugin)
