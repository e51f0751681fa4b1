#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "framework/geometry/convex_contact/hull.h"

namespace presa {

/// The contact of two hulls: one normal, and points that span the touching area. Eight, because two rectangles meet in
/// at most so many corners: with fewer the choice among them would change from step to step.
struct Manifold {
  static constexpr int kMaxPoints = 8;  ///< see above
  /// A point of contact.
  struct Point {
    Vec3 p_W = Vec3::Zero();  ///< halfway between the surfaces
    double gap = 0;           ///< along the normal; negative: overlap [m]
  };
  Vec3 nhat_AB_W = Vec3::UnitZ();        ///< unit, from A into B
  std::array<Point, kMaxPoints> points;  ///< the first `count` are set
  int count = 0;                         ///< 0: they are farther apart than was asked for
};

/// The direction in which two hulls are apart most, or overlap least.
struct Separation {
  Vec3 nhat_AB_W = Vec3::UnitZ();  ///< unit, from A into B
  double gap = 0;                  ///< negative: overlap [m]
};

/// What a contact's normal comes from.
struct ContactAxis {
  /// A face of one of the hulls, or an edge of each.
  enum class Kind : std::uint8_t { kNone, kFaceOfA, kFaceOfB, kEdges };
  Kind kind = Kind::kNone;  ///< kNone: there was no contact
  std::int32_t a = 0,       ///< index of a face or edge of A
      b = 0;                ///< the same of B
};

/// Points at which A and B (both in W) overlap or come within `margin` [m] of each other along `nhat_AB_W`, which was
/// found otherwise with the nearest points `on_a` and `on_b` of the surfaces. Thread: any; nonblocking.
void touchAlong(const Hull& A, const Hull& B, const Vec3& nhat_AB_W, const Vec3& on_a, const Vec3& on_b, double margin,
                Manifold& out) noexcept;

/// Makes the contact of two hulls by the separating axis test: the normal is that of the face, or square to the pair of
/// edges, along which they are separated most (overlap least); the points are the corners of the area in which the two
/// faces along it cover each other [Gregorius2013]. Thread: one at a time.
class ManifoldMaker {
 public:
  /// Reserves memory for hulls of up to so many `edges` and `faces`; more allocate once.
  void makeRoom(std::size_t edges, std::size_t faces) {
    a_on_b_.reserve(edges * faces);
    b_on_a_.reserve(edges * faces);
  }
  /// Points at which A and B (both in W) overlap or come within `margin` [m] of each other. `memory` is the axis of the
  /// step before; it is kept as long as it is nearly the best, since a normal that jumps sets a pile trembling.
  void collide(const Hull& A, const Hull& B, double margin, ContactAxis& memory, Manifold& out);
  /// Exact where A and B overlap; where they are apart, no more than their distance.
  Separation separate(const Hull& A, const Hull& B);

 private:
  struct EdgePair {
    std::int32_t a = -1, b = -1;
    Vec3 nhat = Vec3::Zero();  // from A into B
    double gap = -1e300;
  };
  bool makesFace(const Hull& A, const Hull& B, std::size_t a, std::size_t b) const;
  void separateByEdges(const Hull& A, const Hull& B, EdgePair& best) const;

  std::vector<double> a_on_b_, b_on_a_;  // by edge of one hull and face of the other
};

}  // namespace presa
