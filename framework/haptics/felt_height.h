#pragma once
#include "framework/core/math/spatial.h"

namespace presa {

/// A second face of a surface effect whose flat sides feel as if they had heights: pictures draw them.
class FeltHeight {
 public:
  virtual ~FeltHeight() = default;
  /// Height of the felt surface over the face at p_T, in the face's tangent frame T (tangent_frame.h), z = 0 [m].
  /// Thread: any; nonblocking.
  virtual double heightAt(const Vec3& p_T) const noexcept = 0;
  /// The same of effects that need to know which face it is: X_BT is the frame's pose in the body. Thread: any;
  /// nonblocking.
  virtual double heightAt(const Vec3& p_T, const Pose& /*X_BT*/) const noexcept { return heightAt(p_T); }
};

}  // namespace presa
