#pragma once
#include <array>
#include <cstdint>
#include <limits>
#include <utility>

#include "framework/state/contact_patch.h"
#include "modules/haptics_proxy/convex_piece.h"

namespace presa {

/// What surrounds one fingertip, in the working frame A. The sources are set every tick; the pieces that count are picked
/// around where the fingertip is, so that a fine mesh costs what is touched, not what is near. A pick serves for many
/// ticks: the triangles of a mesh stand still in its body's coordinates, whichever patch brought them.
/// Fixed memory. Thread: haptic; nonblocking.
class Surroundings {
 public:
  static constexpr int kMaxPrimitives = 64;
  static constexpr int kCapacity = kMaxPatchTriangles + kMaxPrimitives;
  /// Sphere within which a patch is complete: the fingertip may not leave it.
  struct Cover {
    Vec3 center = Vec3::Zero();
    double radius = 0;
  };

  /// Starts a tick in the coordinates of body `frame`, with patches of that version.
  void begin(std::int32_t frame, std::uint64_t patch_version) noexcept;
  /// A piece that is always looked at.
  void add(const ConvexPiece& piece) noexcept;
  /// Triangles of one body's patch, in the body's coordinates; X_AB null when A is the body itself. They must outlive the
  /// tick.
  void addTriangles(const PatchTriangle* triangles, const BoundingSphere* bounds, int count, std::int32_t body,
                    const Pose* X_AB, const Cover& cover) noexcept;

  /// Makes piece(0 … count) hold every piece within `reach` of x. A new pick reaches `spare` farther, for the motion to come.
  void lookAround(const Vec3& x, double reach, double spare) noexcept;
  int count() const noexcept { return primitive_count_ + pick_->count; }
  const ConvexPiece& piece(int i) const noexcept {
    return i < primitive_count_ ? primitives_[static_cast<std::size_t>(i)]
                                : pick_->pieces[static_cast<std::size_t>(i - primitive_count_)];
  }
  /// nearest(piece(i), p), remembered as a bound.
  Nearest nearestTo(int i, const Vec3& p) noexcept;
  /// Lower bound of the distance from piece i to p, by what is known of the piece.
  double atLeast(int i, const Vec3& p) const noexcept {
    const Tangent& tangent = tangentOf(i);
    return tangent.nhat.dot(p) + tangent.offset;
  }
  /// How much that bound grows along a way [m].
  double growth(int i, const Vec3& way) const noexcept { return tangentOf(i).nhat.dot(way); }

  int coverCount() const noexcept { return source_count_; }
  const Cover& cover(int i) const noexcept { return sources_[static_cast<std::size_t>(i)].cover; }
  /// Pieces that found no room, since start.
  std::uint32_t overflow() const noexcept { return overflow_; }

 private:
  /// The distance of a convex piece is a convex function of the point, so it lies above each of its tangent planes.
  struct Tangent {
    Vec3 nhat = Vec3::Zero();
    double offset = -std::numeric_limits<double>::infinity();
  };
  struct Source {
    const PatchTriangle* triangles = nullptr;
    const BoundingSphere* bounds = nullptr;
    int count = 0;
    std::int32_t body = kNoBody;
    bool own = true;
    Pose X_AB;
    Cover cover;
  };
  struct Pick {
    Vec3 center = Vec3::Zero();
    double reach = -1;      ///< negative: none
    bool complete = false;  ///< it holds every triangle of the mesh within reach, not only of the patch
    int count = 0;
    std::array<ConvexPiece, kMaxPatchTriangles> pieces;
    std::array<Tangent, kMaxPatchTriangles> tangents;
  };
  const Tangent& tangentOf(int i) const noexcept {
    return i < primitive_count_ ? tangents_[static_cast<std::size_t>(i)]
                                : pick_->tangents[static_cast<std::size_t>(i - primitive_count_)];
  }
  Tangent& tangentOf(int i) noexcept { return const_cast<Tangent&>(std::as_const(*this).tangentOf(i)); }
  void forget() noexcept;
  void fill(Pick& pick, const Vec3& x, double reach) noexcept;
  bool fillFrom(const Source& source, Pick& pick) noexcept;

  std::array<ConvexPiece, kMaxPrimitives> primitives_;
  std::array<Tangent, kMaxPrimitives> tangents_;
  std::array<Source, kMaxNearBodies> sources_;
  // one for the frictionless point, one for where friction holds the fingertip
  std::array<Pick, 2> picks_;
  Pick* pick_ = picks_.data();
  int primitive_count_ = 0, source_count_ = 0;
  int old_source_count_ = 0;  // of the tick before
  std::int32_t frame_ = kNoBody;
  std::uint64_t patch_version_ = 0;
  std::uint32_t overflow_ = 0;
};

}  // namespace presa
