#include "framework/haptics/face_height.h"

#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>

namespace presa {
namespace {

constexpr double kEdge = 1e-4;   // sine of the angle between the normals of contact and face, from which it is an edge
constexpr double kMaxSlope = 1;  // the force leans by at most 45 degrees

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

}  // namespace

Vec3 FacePlace::inA(const Vec3& slope_T) const noexcept {
  const Quat q_AT = input_.X_BA(input_.contact.body).q.conjugate() * X_BT_.q;
  const Vec3 slope = q_AT * slope_T;
  const Vec3 edge = normalOf(input_.contact).cross(q_AT * Vec3::UnitZ());
  return edge.norm() > kEdge ? Vec3(slope.dot(edge) / edge.squaredNorm() * edge) : slope;
}

void addHeight(double height, const Vec3& slope, SurfaceContact& contact) noexcept {
  const Vec3 tilted = contact.nhat - (slope - slope.dot(contact.nhat) * contact.nhat);
  contact.depth = std::fmax(0, contact.depth + height) * tilted.norm();
  contact.nhat = tilted.normalized();
}

FacePattern::FacePattern(const PluginElement& element)
    : pattern_(patternOf(element)),
      amplitude_(element.number("amplitude")),
      wavelength_(element.number("wavelength")),
      across_(acrossOf(element, pattern_)),
      seed_(seedOf(element)) {
  const double direction = element.number("direction") * std::numbers::pi / 180;
  along_T_ = {std::cos(direction), std::sin(direction), 0};
  across_T_ = {-along_T_.y(), along_T_.x(), 0};
  requireGentle(amplitude_ * std::hypot(pattern_.max_ds_du / wavelength_, pattern_.max_ds_dv / across_), amplitude_,
                "these wavelengths");
}

PatternOnFace FacePattern::at(const SurfaceInput& input) const noexcept {
  const FacePlace place(input);
  const PatternValue at = this->at(place.p_T());
  return {at.s, place.inA(amplitude_ * (at.ds_du / wavelength_ * along_T_ + at.ds_dv / across_ * across_T_))};
}

PatternValue FacePattern::at(const Vec3& p_T) const noexcept {
  return pattern_.at(p_T.dot(along_T_) / wavelength_, p_T.dot(across_T_) / across_, seed_);
}

std::string FacePattern::what() const {
  return std::string(pattern_.name) + " of " + inMillimetres(amplitude_) + ", wavelength " +
         inMillimetres(wavelength_) + (pattern_.two_wavelengths ? ", across " + inMillimetres(across_) : std::string{});
}

void requireFlatSides(const PluginElement& element, const World& world) {
  const Body& body = world.scene.bodies[static_cast<std::size_t>(element.body)];
  const Shape& shape = body.haptic->shape;
  if (!std::holds_alternative<Box>(shape) && !std::holds_alternative<MeshRef>(shape))
    throw std::invalid_argument("body '" + body.name + "' has no flat sides; a " + element.element +
                                " needs a box or a mesh");
}

void requireGentle(double slope, double amplitude, const std::string& of) {
  if (!(slope > kMaxSlope)) return;
  std::ostringstream text;
  text << "its slope reaches " << slope << ", above 1; an amplitude of " << inMillimetres(amplitude / slope)
       << " would be the largest for " << of;
  throw std::invalid_argument(text.str());
}

std::string inMillimetres(double length) {
  std::ostringstream text;
  text << length * 1e3 << " mm";
  return text.str();
}

}  // namespace presa
