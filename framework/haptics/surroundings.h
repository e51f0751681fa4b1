#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "framework/core/state/finger_neighbourhood.h"
#include "framework/haptics/convex_piece.h"
#include "framework/haptics/mesh_front.h"

namespace presa {

/// The two points of a fingertip that query its surroundings. Friction may separate them, so each has its own fronts.
enum class Point : std::uint8_t {
  kGodObject,  ///< frictionless god-object
  kHeld        ///< proxy held back by friction
};

/// Identifies one convex piece around a fingertip.
struct PieceRef {
  std::int16_t source;  ///< index of the mesh; -1: a primitive
  std::int32_t item;    ///< item of the mesh's front, or index of the primitive; valid until the next begin()
};

/// A piece with its nearest direction and distance, in the working frame A.
struct NearPiece {
  PieceRef ref;       ///< valid until the next begin()
  std::int32_t body;  ///< index into Scene::bodies
  Nearest at;         ///< from the piece to the queried point
};

/// The convex pieces around one fingertip, in the working frame A. Primitives are added in every tick. Meshes keep a
/// front through their hierarchy from tick to tick, in mesh coordinates (mesh_front.h).
/// Fixed memory after construction. Thread: haptic; nonblocking.
class Surroundings {
 public:
  static constexpr int kMaxPrimitives = 64;   ///< more near one finger: crowded()
  static constexpr int kMaxMeshes = 16;       ///< more near one finger: crowded()
  static constexpr std::size_t kTrail = 520;  ///< points of two motions with the maximum number of legs
  /// `meshes`: maximum number of mesh bodies near the finger at once, at most kMaxMeshes.
  explicit Surroundings(std::size_t meshes = 1);

  /// Starts a tick.
  void begin() noexcept;
  void add(const ConvexPiece& primitive) noexcept;  ///< when full: left out, see crowded()
  /// Adds a mesh body. X_AG null: mesh coordinates are those of A. All queries of this tick must stay within `reach` of
  /// p_A. `cut` may be null; it and X_BG must stay as they are until the next begin(), because a front is seeded only
  /// when a query needs it.
  void addMesh(std::int32_t body, const MeshTree& tree, const Pose* X_AG, const Pose& X_BG, const NearBody* cut,
               const Vec3& p_A, double reach) noexcept;
  /// Selects the point whose fronts the calls below use.
  void use(Point point) noexcept {
    point_ = static_cast<std::size_t>(point);
    trail_count_ = 0;
    focus_radius_ = -1;
  }

  /// The triangle that a piece of a point's fronts is; does not change the point or its trail.
  struct Triangle {
    const MeshTree* tree = nullptr;          ///< mesh's own; null for a primitive
    const MeshTree::Facet* facet = nullptr;  ///< null, like `tree`, for a primitive
    Vec3 x_G = Vec3::Zero();                 ///< the given point in mesh coordinates
  };
  /// `point` need not be the one in use; x in A.
  Triangle triangleOf(Point point, const PieceRef& ref, const Vec3& x) const noexcept;
  /// Of the point in use.
  Triangle triangleOf(const PieceRef& ref, const Vec3& x) const noexcept {
    return triangleOf(static_cast<Point>(point_), ref, x);
  }

  /// Selects the pieces that may come within `radius` of x; the queries below examine only these until the next
  /// focus().
  void focus(const Vec3& x, double radius) noexcept {
    focus_center_ = x;
    focus_radius_ = radius;
    for (std::size_t m = 0; m < near_count_; ++m) front(*near_[m]).focus(near_[m]->toG(x), radius, step_);
  }
  /// Distance that the HIP moved in this tick relative to the touched body [m]; used to plan the focus.
  double step() const noexcept { return step_; }
  void setStep(double step) noexcept { step_ = step; }  ///< before focus() of the tick

  /// Calls visit(const NearPiece&) for every piece in focus whose distance from x is at most `limit`. A visit may lower
  /// it.
  template <class Visit>
  void forEachWithin(const Vec3& x, const double& limit, const Visit& visit) noexcept;
  /// As above for one source: mesh 0 … meshCount() - 1, or -1 for the primitives.
  template <class Visit>
  void forEachWithin(int source, const Vec3& x, const double& limit, const Visit& visit) noexcept;
  /// `i` as in PieceRef::item, unchecked.
  const ConvexPiece& primitive(int i) const noexcept { return primitives_[static_cast<std::size_t>(i)]; }
  int meshCount() const noexcept { return static_cast<int>(near_count_); }  ///< meshes of this tick
  /// First s in [0, reach] at which a sphere of radius r, whose centre moves from x to x + s move, touches an unmarked
  /// piece in focus; `reach` when none.
  double firstTouch(const Vec3& x, const Vec3& move, double reach, double r, const SweepTolerance& tolerance) noexcept;
  void clearMarks() noexcept;               ///< of the point in use, and of primitives
  void mark(const PieceRef& ref) noexcept;  ///< firstTouch() passes over it until clearMarks()

  /// Rotation from the mesh coordinates of a piece to A.
  Mat3 turnOf(const PieceRef& ref) const noexcept {
    const Mesh* const mesh = ref.source < 0 ? nullptr : near_[static_cast<std::size_t>(ref.source)];
    return mesh == nullptr || mesh->own ? Mat3(Mat3::Identity()) : mesh->X_AG.q.toRotationMatrix();
  }

  /// Records that the current point passes through x in this tick.
  void leaveTrail(const Vec3& x) noexcept {
    if (trail_count_ == static_cast<int>(trail_.size())) --trail_count_;  // when full, the path gets coarser
    trail_[static_cast<std::size_t>(trail_count_++)] = x;
  }
  /// Independent test for pop-through, to be called with the centre x at the end of a tick. True when the path since
  /// the end of the last tick crosses a triangle in mesh coordinates, or when x is newly inside a primitive. `r`:
  /// fingertip radius, used as a guess of the clearance; it affects only the cost.
  bool passedThrough(const Vec3& x, double r) noexcept;

  /// True when a mesh front of the current point is full.
  bool full() const noexcept;
  /// Reseeds full fronts at x, dropping items left behind on the path.
  void renew(const Vec3& x) noexcept {
    for (std::size_t m = 0; m < near_count_; ++m) front(*near_[m]).renew(near_[m]->toG(x));
  }
  /// True when something within reach found no room in this tick.
  bool crowded() const noexcept;

 private:
  /// Fronts of a mesh body, kept while it is near.
  struct Mesh {
    std::int32_t body = kNoBody;
    const MeshTree* tree = nullptr;
    std::uint64_t last_tick = 0;
    // values of this tick
    bool own = true;
    Pose X_AG;  // of another than `own`
    const Pose* X_BG = nullptr;
    const NearBody* cut = nullptr;
    Vec3 p_G = Vec3::Zero();
    double reach = 0;
    std::array<bool, 2> covers{};  // whether each front covers `reach` of p_G: from its first query of the tick on
    // ball covered by the seed of each front, in mesh coordinates G; infinite radius: the whole mesh
    std::array<Vec3, 2> center_G{Vec3::Zero(), Vec3::Zero()};
    std::array<double, 2> radius{};
    std::array<MeshFront, 2> fronts;
    // centre of the fingertip at the end of the last tick, and a distance within which there is no surface
    Vec3 last_x_G = Vec3::Zero();
    double clearance = -1;
    bool followed = false;

    Vec3 toG(const Vec3& x) const noexcept { return own ? x : X_AG.inverseTimes(x); }
    Vec3 turnToG(const Vec3& v) const noexcept { return own ? v : Vec3(X_AG.q.conjugate() * v); }
    Nearest toA(const Nearest& at) const noexcept { return own ? at : Nearest{X_AG.q * at.nhat, at.distance}; }
  };
  Mesh* meshOf(std::int32_t body) noexcept;
  /// Follows the trail to x; true when the path crosses a triangle of the mesh.
  bool follow(Mesh& mesh, const Vec3& x, double r) noexcept;
  /// Whether every piece that could be crossed at x is in focus.
  bool inFocus(const Vec3& x) const noexcept { return (x - focus_center_).norm() <= 0.999 * focus_radius_; }
  /// The mesh's front of the point in use, for queries of this tick.
  MeshFront& front(Mesh& mesh) noexcept {
    if (!mesh.covers[point_]) cover(mesh, point_);
    return mesh.fronts[point_];
  }
  static void cover(Mesh& mesh, std::size_t point) noexcept;
  static void seed(Mesh& mesh, std::size_t point) noexcept;

  std::array<ConvexPiece, kMaxPrimitives> primitives_;
  std::array<TangentBound, kMaxPrimitives> tangents_;
  std::array<bool, kMaxPrimitives> primitive_marks_{};
  int primitive_count_ = 0;
  bool inside_primitive_ = false;
  std::vector<std::unique_ptr<Mesh>> meshes_;  // all slots
  std::array<Mesh*, kMaxMeshes> near_{};       // meshes of this tick
  std::size_t near_count_ = 0;
  std::size_t point_ = 0;
  std::uint64_t tick_ = 0;
  double step_ = 0;
  Vec3 focus_center_ = Vec3::Zero();
  double focus_radius_ = -1;
  std::array<Vec3, kTrail> trail_;
  std::array<Vec3, kTrail + 2> way_;  // path of the fingertip's centre in this tick, in coordinates of one mesh
  int trail_count_ = 0;
  bool no_room_ = false;
};

template <class Visit>
void Surroundings::forEachWithin(int source, const Vec3& x, const double& limit, const Visit& visit) noexcept {
  if (source >= 0) {
    Mesh& mesh = *near_[static_cast<std::size_t>(source)];
    front(mesh).forEachWithin(mesh.toG(x), limit, [&](int item, const Nearest& at) {
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
