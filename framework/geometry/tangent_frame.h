#pragma once
#include "framework/core/math/spatial.h"

namespace presa {

/// X_BT of the tangent frame T on a face of body B (PERCRO paper, figure 8): fixed to the body, z along the face's unit
/// normal, x along the body's x axis as seen in the face (its y axis on a face within 8 degrees across x), origin at
/// the point of the face's plane nearest to the body's origin. Faces in one plane, such as the triangles of a flat
/// side, have the same frame. `p_B` lies in the plane. Any thread; nonblocking.
Pose tangentFrame(const Vec3& nhat_B, const Vec3& p_B) noexcept;

}  // namespace presa
