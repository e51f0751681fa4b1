#pragma once
#include <cstdint>
#include <string>

namespace presa {

/// Value and gradient of a pattern at one point.
struct PatternValue {
  double s = 0;      ///< in [-1, 1]
  double ds_du = 0,  ///< slope along u [per length of a wave]
      ds_dv = 0;     ///< slope along v [per length of a wave]
};

/// A pattern over the plane (u, v), in lengths of its waves: |s| <= 1, twice continuously differentiable.
struct Pattern {
  const char* name;  ///< "sine", "grid" or "noise"
  /// Thread: any; nonblocking.
  PatternValue (*at)(double u, double v, std::uint64_t seed) noexcept;
  double max_ds_du,      ///< upper bound of |ds_du|
      max_ds_dv;         ///< upper bound of |ds_dv|; in any point both at once
  bool two_wavelengths;  ///< varies along v, too
};

/// "sine", "grid" or "noise"; null for any other name.
///   sine   s = sin(2 pi u)
///   grid   s = (sin(2 pi u) + sin(2 pi v)) / 2
///   noise  gradient noise [Perlin2002] on the square lattice of whole u and v. The same on every machine: the lattice
///          gradients come from an integer hash.
const Pattern* findPattern(const std::string& name);

}  // namespace presa
