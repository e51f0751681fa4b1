#include <algorithm>
#include <cmath>

#include "framework/geometry/closest_point.h"
#include "modules/haptics_proxy/god_object.h"

namespace presa {

void Surroundings::add(const ConvexPiece& piece) noexcept {
  reach_ = -1;
  if (primitive_count_ < kMaxPrimitives) {
    primitives_[static_cast<std::size_t>(primitive_count_++)] = piece;
  } else {
    ++overflow_;
  }
}

void Surroundings::addTriangles(const PatchTriangle* triangles, int count, std::int32_t body, const Pose* X_AB,
                                const Cover& cover) noexcept {
  if (source_count_ == kMaxNearBodies) {
    ++overflow_;
    return;
  }
  reach_ = -1;
  Source& source = sources_[static_cast<std::size_t>(source_count_++)];
  source.triangles = triangles;
  source.count = count;
  source.body = body;
  source.own = X_AB == nullptr;
  if (X_AB != nullptr) source.X_AB = *X_AB;
  source.cover = cover;
}

void Surroundings::lookAround(const Vec3& x, double r, double margin) noexcept {
  const double reach = r + margin;
  if ((x - center_).norm() + reach <= reach_) return;
  center_ = x;
  reach_ = reach;
  count_ = 0;
  for (int i = 0; i < primitive_count_; ++i) {
    distance_[static_cast<std::size_t>(count_)] = -1;
    pieces_[static_cast<std::size_t>(count_++)] = primitives_[static_cast<std::size_t>(i)];
  }
  for (int s = 0; s < source_count_; ++s) {
    const Source& source = sources_[static_cast<std::size_t>(s)];
    const Vec3 x_B = source.own ? x : source.X_AB.inverseTimes(x);
    for (int t = 0; t < source.count; ++t) {
      const auto& v = source.triangles[t].v_B;
      // cheap first: no point of the triangle is farther from its first corner than its longer edge there
      const double edge = std::max((v[1] - v[0]).squaredNorm(), (v[2] - v[0]).squaredNorm());
      const double corner = (v[0] - x_B).squaredNorm();
      if (corner > reach * reach + edge + 2 * reach * std::sqrt(edge)) continue;
      const double squared = (closestOnTriangle(x_B, v[0], v[1], v[2]) - x_B).squaredNorm();
      if (squared > reach * reach) continue;
      if (count_ == kCapacity) {
        ++overflow_;
        return;
      }
      distance_[static_cast<std::size_t>(count_)] = std::sqrt(squared);
      ConvexPiece& piece = pieces_[static_cast<std::size_t>(count_++)];
      piece.kind = ConvexPiece::Kind::kTriangle;
      piece.body = source.body;
      piece.a = source.own ? v[0] : source.X_AB * v[0];
      piece.b = source.own ? v[1] : source.X_AB * v[1];
      piece.c = source.own ? v[2] : source.X_AB * v[2];
    }
  }
}

}  // namespace presa
