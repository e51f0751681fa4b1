#include "modules/haptics_proxy/surroundings.h"

#include <cmath>

namespace presa {
namespace {

bool same(const Pose& a, const Pose& b) noexcept { return a.p == b.p && a.q.coeffs() == b.q.coeffs(); }

}  // namespace

void Surroundings::begin(std::int32_t frame, std::uint64_t patch_version) noexcept {
  for (Pick& pick : picks_) {
    if (frame != frame_ || (!pick.complete && patch_version != patch_version_)) pick.reach = -1;
  }
  frame_ = frame;
  patch_version_ = patch_version;
  old_source_count_ = source_count_;
  primitive_count_ = source_count_ = 0;
}

void Surroundings::forget() noexcept {
  for (Pick& pick : picks_) pick.reach = -1;
}

void Surroundings::add(const ConvexPiece& piece) noexcept {
  if (primitive_count_ == kMaxPrimitives) {
    ++overflow_;
    return;
  }
  const auto i = static_cast<std::size_t>(primitive_count_++);
  primitives_[i] = piece;
  tangents_[i] = {};
}

void Surroundings::addTriangles(const PatchTriangle* triangles, const BoundingSphere* bounds, int count,
                                std::int32_t body, const Pose* X_AB, const Cover& cover) noexcept {
  if (source_count_ == kMaxNearBodies) {
    ++overflow_;
    return;
  }
  Source& source = sources_[static_cast<std::size_t>(source_count_)];
  const bool own = X_AB == nullptr;
  const Pose placed = own ? Pose{} : *X_AB;
  // what was picked stays true as long as every body is where it was in A
  const bool known = source_count_ < old_source_count_ && source.body == body && same(source.X_AB, placed);
  if (!known) forget();
  source = {triangles, bounds, count, body, own, placed, cover};
  ++source_count_;
}

void Surroundings::lookAround(const Vec3& x, double reach, double spare) noexcept {
  if (source_count_ < old_source_count_) {
    forget();
    old_source_count_ = source_count_;
  }
  for (Pick& pick : picks_) {
    if ((x - pick.center).norm() + reach > pick.reach) continue;
    pick_ = &pick;
    return;
  }
  pick_ = pick_ == &picks_[0] ? &picks_[1] : &picks_[0];
  fill(*pick_, x, reach + spare);
}

void Surroundings::fill(Pick& pick, const Vec3& x, double reach) noexcept {
  pick.center = x;
  pick.reach = reach;
  pick.complete = true;
  pick.count = 0;
  for (int s = 0; s < source_count_; ++s) {
    const Source& source = sources_[static_cast<std::size_t>(s)];
    pick.complete = pick.complete && (x - source.cover.center).norm() + reach <= source.cover.radius;
    if (!fillFrom(source, pick)) return;
  }
}

// False when the pick is full.
bool Surroundings::fillFrom(const Source& source, Pick& pick) noexcept {
  const Vec3 x_B = source.own ? pick.center : source.X_AB.inverseTimes(pick.center);
  for (int t = 0; t < source.count; ++t) {
    const BoundingSphere& bound = source.bounds[t];
    const Vec3 away_B = x_B - bound.center;
    const double far = pick.reach + bound.radius, squared = away_B.squaredNorm();
    if (squared > far * far) continue;
    if (pick.count == kMaxPatchTriangles) {
      ++overflow_;
      pick.complete = false;
      return false;
    }
    const auto i = static_cast<std::size_t>(pick.count++);
    const PatchTriangle& triangle = source.triangles[t];
    const auto& v = triangle.v_B;
    ConvexPiece& piece = pick.pieces[i];
    piece.body = source.body;
    piece.id = triangle.id;
    if (source.own) {
      piece.shape.emplace<PreparedTriangle>(v[0], v[1], v[2]);
    } else {
      piece.shape.emplace<PreparedTriangle>(source.X_AB * v[0], source.X_AB * v[1], source.X_AB * v[2]);
    }
    // the distance from the bounding sphere is a first bound; the exact one is taken where it matters
    Tangent& tangent = pick.tangents[i];
    const double distance = std::sqrt(squared);
    if (distance > bound.radius) {
      tangent.nhat = source.own ? Vec3(away_B / distance) : Vec3(source.X_AB.q * (away_B / distance));
      tangent.offset = distance - bound.radius - tangent.nhat.dot(pick.center);
    } else {
      tangent = {Vec3::Zero(), 0};
    }
  }
  return true;
}

Nearest Surroundings::nearestTo(int i, const Vec3& p) noexcept {
  const Nearest at = nearest(piece(i), p);
  // on a triangle the direction is arbitrary and bounds nothing
  if (at.distance != 0) tangentOf(i) = {at.nhat, at.distance - at.nhat.dot(p)};
  return at;
}

}  // namespace presa
