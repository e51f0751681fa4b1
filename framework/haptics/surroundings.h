#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "framework/core/state/contact_patch.h"
#include "framework/haptics/convex_piece.h"
#include "framework/haptics/mesh_front.h"

namespace presa {

/// Which of a fingertip's two points looks around: they part where friction holds one back, and each keeps fronts of its own.
enum class Point : std::uint8_t {
  kGodObject,  ///< slides freely
  kHeld        ///< held by friction
};

/// One convex piece of what surrounds a fingertip.
struct PieceRef {
  std::int16_t source;  ///< mesh; -1: a primitive
  std::int32_t item;    ///< of the front or of the primitives; holds until the next begin()
};

/// A piece where it is nearest to some point, in the working frame A.
struct NearPiece {
  PieceRef ref;
  std::int32_t body;
  Nearest at;
};

/// What surrounds one fingertip, in the working frame A. Primitives are set every tick; meshes stand still in their own
/// coordinates, where a front through each one's hierarchy is kept from tick to tick (mesh_front).
/// Fixed memory after construction. Thread: haptic; nonblocking.
class Surroundings {
 public:
  static constexpr int kMaxPrimitives = 64;
  static constexpr int kMaxMeshes = 16;
  static constexpr std::size_t kTrail = 520;  ///< two motions of all the legs there may be

  /// `meshes`: bodies with a mesh that the finger may be near to at once; more than kMaxMeshes are not.
  explicit Surroundings(std::size_t meshes = 1);

  /// Starts a tick.
  void begin() noexcept;
  void add(const ConvexPiece& primitive) noexcept;
  /// A mesh body; X_AG null when its coordinates are those of A. Everything that is looked at in this tick lies within `reach`
  /// of p_A. `cut` may be null.
  void addMesh(std::int32_t body, const MeshTree& tree, const Pose* X_AG, const Pose& X_BG, const NearBody* cut,
               const Vec3& p_A, double reach) noexcept;
  /// Whose fronts the calls below look through.
  void use(Point point) noexcept {
    point_ = static_cast<std::size_t>(point);
    trail_count_ = 0;
    focus_radius_ = -1;
  }

  /// Picks the pieces that may come within `radius` of x: all that the queries below look through until the next focus().
  void focus(const Vec3& x, double radius) noexcept {
    focus_center_ = x;
    focus_radius_ = radius;
    for (std::size_t m = 0; m < near_count_; ++m) near_[m]->fronts[point_].focus(near_[m]->toG(x), radius, step_);
  }
  /// How far the HIP came in this tick, as seen from what it touches: how far a fingertip will have to look [m].
  double step() const noexcept { return step_; }
  void setStep(double step) noexcept { step_ = step; }

  /// Calls visit(const NearPiece&) for every piece in focus whose distance from x is at most `limit`; a visit may lower it.
  template <class Visit>
  void forEachWithin(const Vec3& x, const double& limit, const Visit& visit) noexcept;
  /// The same of one source alone: mesh 0 … meshCount() - 1, or the primitives, -1.
  template <class Visit>
  void forEachWithin(int source, const Vec3& x, const double& limit, const Visit& visit) noexcept;
  const ConvexPiece& primitive(int i) const noexcept { return primitives_[static_cast<std::size_t>(i)]; }
  int meshCount() const noexcept { return static_cast<int>(near_count_); }
  /// First s in [0, reach] at which a sphere of radius r on its way from x along `move` touches a piece in focus that is not
  /// marked; `reach` when none.
  double firstTouch(const Vec3& x, const Vec3& move, double reach, double r, const SweepTolerance& tolerance) noexcept;
  void clearMarks() noexcept;
  void mark(const PieceRef& ref) noexcept;

  /// A triangle that holds the fingertip: null for a primitive.
  struct Triangle {
    const MeshTree* tree = nullptr;
    const MeshTree::Facet* facet = nullptr;
    Vec3 x_G = Vec3::Zero();  ///< the point asked for, in mesh coordinates
  };
  Triangle triangleOf(const PieceRef& ref, const Vec3& x) const noexcept;
  /// Rotation from the coordinates of a piece's mesh to A.
  Mat3 turnOf(const PieceRef& ref) const noexcept {
    return ref.source < 0 ? Mat3(Mat3::Identity())
                          : near_[static_cast<std::size_t>(ref.source)]->X_AG.q.toRotationMatrix();
  }

  /// The point in use goes by way of x in this tick.
  void leaveTrail(const Vec3& x) noexcept {
    if (trail_count_ == static_cast<int>(trail_.size())) --trail_count_;  // the way is judged the more coarsely
    trail_[static_cast<std::size_t>(trail_count_++)] = x;
  }
  /// The fingertip's centre is at x at the end of a tick. True when its way since the end of the last one, seen from a mesh,
  /// crosses a triangle of it, or when it is inside a primitive now: judged by the surfaces, not by what moved it. r: radius of
  /// the fingertip; a guess of how far off the surface its centre keeps, which costs time where it is wrong.
  bool passedThrough(const Vec3& x, double r) noexcept;

  /// Something that the point in use can reach found no room.
  bool full() const noexcept;
  /// Makes room by leaving behind what was passed on the way to x.
  void renew(const Vec3& x) noexcept {
    for (std::size_t m = 0; m < near_count_; ++m) near_[m]->fronts[point_].renew(near_[m]->toG(x));
  }
  /// Something in reach found no room in this tick.
  bool crowded() const noexcept;

 private:
  /// A mesh body, kept while it is near.
  struct Mesh {
    std::int32_t body = kNoBody;
    const MeshTree* tree = nullptr;
    std::uint64_t last_tick = 0;
    // of this tick
    bool own = true;
    Pose X_AG;
    // what the fronts hold everything in, coordinates G; radius infinite: all of the mesh
    std::array<Vec3, 2> center_G{Vec3::Zero(), Vec3::Zero()};
    std::array<double, 2> radius{};
    std::array<MeshFront, 2> fronts;
    // the fingertip's centre at the end of the last tick, and how far from there nothing is
    Vec3 last_x_G = Vec3::Zero();
    double clearance = -1;
    bool followed = false;

    Vec3 toG(const Vec3& x) const noexcept { return own ? x : X_AG.inverseTimes(x); }
    Vec3 turnToG(const Vec3& v) const noexcept { return own ? v : Vec3(X_AG.q.conjugate() * v); }
    Nearest toA(const Nearest& at) const noexcept { return own ? at : Nearest{X_AG.q * at.nhat, at.distance}; }
  };
  Mesh* meshOf(std::int32_t body) noexcept;
  /// Goes along the trail and on to x; true when a triangle of the mesh is crossed on the way.
  bool follow(Mesh& mesh, const Vec3& x, double r) noexcept;
  /// Whatever a way through x crosses at x is in focus.
  bool inFocus(const Vec3& x) const noexcept { return (x - focus_center_).norm() <= 0.999 * focus_radius_; }
  static void seed(Mesh& mesh, std::size_t point, const NearBody* cut, const Pose& X_BG, const Vec3& p_G,
                   double reach) noexcept;

  std::array<ConvexPiece, kMaxPrimitives> primitives_;
  std::array<TangentBound, kMaxPrimitives> tangents_;
  std::array<bool, kMaxPrimitives> primitive_marks_{};
  int primitive_count_ = 0;
  bool inside_primitive_ = false;
  std::vector<std::unique_ptr<Mesh>> meshes_;  // the room there is
  std::array<Mesh*, kMaxMeshes> near_{};       // those of this tick
  std::size_t near_count_ = 0;
  std::size_t point_ = 0;
  std::uint64_t tick_ = 0;
  double step_ = 0;
  Vec3 focus_center_ = Vec3::Zero();
  double focus_radius_ = -1;
  std::array<Vec3, kTrail> trail_;
  std::array<Vec3, kTrail + 2> way_;  // of the fingertip's centre in this tick, coordinates of one mesh
  int trail_count_ = 0;
  bool no_room_ = false;
};

template <class Visit>
void Surroundings::forEachWithin(int source, const Vec3& x, const double& limit, const Visit& visit) noexcept {
  if (source >= 0) {
    Mesh& mesh = *near_[static_cast<std::size_t>(source)];
    mesh.fronts[point_].forEachWithin(mesh.toG(x), limit, [&](int item, const Nearest& at) {
      visit(NearPiece{{static_cast<std::int16_t>(source), item}, mesh.body, mesh.toA(at)});
    });
    return;
  }
  for (int i = 0; i < primitive_count_; ++i) {
    TangentBound& tangent = tangents_[static_cast<std::size_t>(i)];
    if (tangent.at(x) > limit) continue;
    const ConvexPiece& piece = primitives_[static_cast<std::size_t>(i)];
    const Nearest at = nearest(piece, x);
    tangent = {at.nhat, at.distance - at.nhat.dot(x)};
    if (at.distance <= limit) visit(NearPiece{{-1, i}, piece.body, at});
  }
}

template <class Visit>
void Surroundings::forEachWithin(const Vec3& x, const double& limit, const Visit& visit) noexcept {
  for (int source = -1; source < meshCount(); ++source) forEachWithin(source, x, limit, visit);
}

}  // namespace presa
