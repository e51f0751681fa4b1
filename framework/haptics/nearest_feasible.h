#pragma once
#include <array>
#include <cstdint>

#include "framework/core/math/spatial.h"

namespace presa {

/// Half-space nhat . y >= offset.
struct HalfSpace {
  Vec3 nhat;         ///< unit, into the half-space
  double offset;     ///< [m]
  std::int32_t tag;  ///< caller's identifier
};

/// A small set of half-spaces in fixed memory.
struct HalfSpaces {
  static constexpr int kCapacity = 12;    ///< planes around one proxy
  std::array<HalfSpace, kCapacity> item;  ///< the first `count` are set
  int count = 0;                          ///< half-spaces in use

  /// Adds a half-space, merging equal normals. When full, keeps the most restrictive ones at `x`. False: one was left
  /// out.
  bool add(const HalfSpace& half_space, const Vec3& x) noexcept;
};

/// Solution of nearestFeasible().
struct Feasible {
  Vec3 y = Vec3::Zero();                  ///< nearest point; the least violated candidate if there is none
  std::array<int, 3> active{-1, -1, -1};  ///< indices of the active constraints, at most three
  std::array<double, 3> weight{};         ///< their multipliers: y - g is the sum of weight * nhat
  int active_count = 0;                   ///< 0 to 3; 0: the goal itself satisfies all
};

/// The point y nearest to g that satisfies all half-spaces: the god-object's quadratic programme [Zilles1995 eq. 7],
/// solved exactly by its active set (at most three in space). If the half-spaces have no common point, returns the
/// least violated candidate. Thread: any; nonblocking.
Feasible nearestFeasible(const HalfSpaces& half_spaces, const Vec3& g) noexcept;

}  // namespace presa
