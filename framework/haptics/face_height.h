#pragma once
#include <string>

#include "framework/haptics/height_pattern.h"
#include "framework/haptics/surface_effect.h"

namespace presa {

/// Where a tool touches a flat face, in the face's tangent frame T. Thread: haptic; nonblocking.
class FacePlace {
 public:
  /// Keeps a reference to `input`.
  explicit FacePlace(const SurfaceInput& input) noexcept : input_(input), X_BT_(input.X_BT()) {}
  /// The touched point; x and y are its place on the face [m].
  Vec3 p_T() const noexcept { return X_BT_.inverseTimes(input_.touched_B()); }
  /// A gradient over the face in the working frame A. On an edge, where the touched point moves along the edge only,
  /// its part along the edge.
  Vec3 inA(const Vec3& slope_T) const noexcept;

 private:
  const SurfaceInput& input_;
  Pose X_BT_;
};

/// Gives the contact the force of the stored energy k max(0, depth + height)^2 / 2: k (depth + height) (nhat - slope).
/// With heights <= 0 it begins at zero. `slope`: gradient of the height in A. Thread: haptic; nonblocking.
void addHeight(double height, const Vec3& slope, SurfaceContact& contact) noexcept;

/// A pattern at one place, and the gradient of amplitude * s over the face, in A.
struct PatternOnFace {
  double s = 0;               ///< in [-1, 1]
  Vec3 slope = Vec3::Zero();  ///< gradient of amplitude * s over the face, in A [-]
};

/// A pattern over flat faces, from the attributes of an element: shape, amplitude, wavelength, direction, across, seed
/// (modules/texture/manifest.xml). Thread: main; `at`: haptic, nonblocking.
class FacePattern {
 public:
  /// Throws std::invalid_argument: an unknown shape, values that do not fit together, slopes above 1.
  explicit FacePattern(const PluginElement& element);
  PatternOnFace at(const SurfaceInput& input) const noexcept;  ///< at the touched point; haptic thread
  /// At a place in the face's tangent frame; in lengths of the waves. Thread: any; nonblocking.
  PatternValue at(const Vec3& p_T) const noexcept;
  double amplitude() const noexcept { return amplitude_; }  ///< [m]
  /// "sine of 0.1 mm, wavelength 2 mm"
  std::string what() const;

 private:
  const Pattern& pattern_;
  double amplitude_, wavelength_, across_;  // [m]
  std::uint64_t seed_;
  Vec3 along_T_, across_T_;  // unit vectors in the tangent frame
};

/// Throws std::invalid_argument unless the body of the element has flat sides: a box or a mesh. A curved primitive has
/// another tangent frame at each point, so no place on it.
void requireFlatSides(const PluginElement& element, const World& world);

/// Throws std::invalid_argument if a slope is above 1: the force would lean by more than 45 degrees. `of`: for what the
/// text gives the largest amplitude, "these wavelengths".
void requireGentle(double slope, double amplitude, const std::string& of);

/// "0.1 mm"
std::string inMillimetres(double length);

}  // namespace presa
