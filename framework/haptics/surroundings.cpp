#include "framework/haptics/surroundings.h"

#include <algorithm>

namespace presa {

Surroundings::Surroundings(std::size_t meshes) {
  for (std::size_t i = 0; i < std::min<std::size_t>(meshes, kMaxMeshes); ++i)
    meshes_.push_back(std::make_unique<Mesh>());
}

void Surroundings::begin() noexcept {
  ++tick_;
  primitive_count_ = 0;
  near_count_ = 0;
  no_room_ = false;
  point_ = 0;
}

void Surroundings::add(const ConvexPiece& primitive) noexcept {
  if (primitive_count_ == kMaxPrimitives) {
    no_room_ = true;
    return;
  }
  const auto i = static_cast<std::size_t>(primitive_count_++);
  primitives_[i] = primitive;
  tangents_[i] = {Vec3::Zero(), -std::numeric_limits<double>::infinity()};
}

// The slot that belongs to the body, else the slot not used for the longest time.
Surroundings::Mesh* Surroundings::meshOf(std::int32_t body) noexcept {
  Mesh* oldest = nullptr;
  for (const auto& mesh : meshes_) {
    if (mesh->body == body) return mesh.get();
    if (mesh->last_tick != tick_ && (oldest == nullptr || mesh->last_tick < oldest->last_tick)) oldest = mesh.get();
  }
  if (oldest != nullptr) {
    oldest->body = body;
    oldest->followed = false;
    for (MeshFront& front : oldest->fronts) front.forget();
  }
  return oldest;
}

void Surroundings::addMesh(std::int32_t body, const MeshTree& tree, const Pose* X_AG, const Pose& X_BG,
                           const NearBody* cut, const Vec3& p_A, double reach) noexcept {
  Mesh* mesh = near_count_ == near_.size() ? nullptr : meshOf(body);
  if (mesh == nullptr) {
    no_room_ = true;
    return;
  }
  if (mesh->last_tick + 1 != tick_) mesh->followed = false;
  mesh->last_tick = tick_;
  mesh->tree = &tree;
  mesh->own = X_AG == nullptr;
  if (!mesh->own) mesh->X_AG = *X_AG;
  mesh->X_BG = &X_BG;
  mesh->cut = cut;
  mesh->p_G = mesh->toG(p_A);
  mesh->reach = reach;
  mesh->covers.fill(false);
  near_[near_count_++] = mesh;
}

void Surroundings::cover(Mesh& mesh, std::size_t point) noexcept {
  MeshFront& front = mesh.fronts[point];
  const bool covers = (mesh.p_G - mesh.center_G[point]).norm() + mesh.reach <= mesh.radius[point];
  if (!front.seeded() || front.worn() || front.full() || !covers) seed(mesh, point);
  mesh.covers[point] = true;
}

// Seeds from the collision thread's cut when it covers the reach, else from the root: slower once, but equally correct.
void Surroundings::seed(Mesh& mesh, std::size_t point) noexcept {
  static constexpr std::array<std::int32_t, 1> kWhole{MeshTree::kRoot};
  const NearBody* const cut = mesh.cut;
  const Vec3 center_G = cut != nullptr ? mesh.X_BG->inverseTimes(cut->center_B) : Vec3::Zero();
  if (cut != nullptr && cut->cut_count > 0 && (mesh.p_G - center_G).norm() + mesh.reach <= cut->radius) {
    mesh.fronts[point].seed(*mesh.tree, {cut->cut.data(), static_cast<std::size_t>(cut->cut_count)}, mesh.p_G);
    mesh.center_G[point] = center_G;
    mesh.radius[point] = cut->radius;
  } else {
    mesh.fronts[point].seed(*mesh.tree, kWhole, mesh.p_G);
    mesh.center_G[point] = mesh.p_G;
    mesh.radius[point] = std::numeric_limits<double>::infinity();
  }
}

double Surroundings::firstTouch(const Vec3& x, const Vec3& move, double reach, double r,
                                const SweepTolerance& tolerance) noexcept {
  for (int i = 0; i < primitive_count_; ++i) {
    TangentBound& tangent = tangents_[static_cast<std::size_t>(i)];
    if (tangent.at(x) + std::min(0.0, reach * tangent.nhat.dot(move)) > r) continue;
    if (primitive_marks_[static_cast<std::size_t>(i)]) continue;
    const ConvexPiece& piece = primitives_[static_cast<std::size_t>(i)];
    const Nearest at = nearest(piece, x);
    tangent = {at.nhat, at.distance - at.nhat.dot(x)};
    reach = std::min(reach, presa::firstTouch(piece, at, x, move, reach, r, tolerance.touch));
  }
  for (std::size_t m = 0; m < near_count_; ++m) {
    Mesh& mesh = *near_[m];
    reach = front(mesh).firstTouch(mesh.toG(x), mesh.turnToG(move), reach, r, tolerance);
  }
  return reach;
}

void Surroundings::clearMarks() noexcept {
  std::fill_n(primitive_marks_.begin(), primitive_count_, false);
  for (std::size_t m = 0; m < near_count_; ++m) near_[m]->fronts[point_].clearMarks();
}

void Surroundings::mark(const PieceRef& ref) noexcept {
  if (ref.source < 0) {
    primitive_marks_[static_cast<std::size_t>(ref.item)] = true;
  } else {
    near_[static_cast<std::size_t>(ref.source)]->fronts[point_].mark(ref.item);
  }
}

Surroundings::Triangle Surroundings::triangleOf(Point point, const PieceRef& ref, const Vec3& x) const noexcept {
  if (ref.source < 0) return {};
  const Mesh& mesh = *near_[static_cast<std::size_t>(ref.source)];
  const std::int32_t facet = mesh.fronts[static_cast<std::size_t>(point)].facetOf(ref.item);
  if (facet < 0) return {};
  return {mesh.tree, &mesh.tree->facet(facet), mesh.toG(x)};
}

bool Surroundings::passedThrough(const Vec3& x, double r) noexcept {
  bool inside = false;
  for (int i = 0; i < primitive_count_ && !inside; ++i) {
    const auto n = static_cast<std::size_t>(i);
    inside = tangents_[n].at(x) < 0 && nearest(primitives_[n], x).distance < 0;
  }
  bool passed = inside && !inside_primitive_;
  inside_primitive_ = inside;
  for (std::size_t m = 0; m < near_count_; ++m) passed = follow(*near_[m], x, r) || passed;
  return passed;
}

bool Surroundings::follow(Mesh& mesh, const Vec3& x, double r) noexcept {
  if (!mesh.followed) {
    mesh.followed = true;
    mesh.clearance = 0;
    mesh.last_x_G = mesh.toG(x);
    return false;
  }
  std::size_t count = 0;
  bool focused = inFocus(x) && inFocus(mesh.own ? mesh.last_x_G : mesh.X_AG * mesh.last_x_G);
  double length = 0;
  way_[count++] = mesh.last_x_G;
  const auto go = [&](const Vec3& p_G) {
    const double leg = (p_G - way_[count - 1]).norm();
    if (leg == 0) return;
    length += leg;
    way_[count++] = p_G;
  };
  for (std::size_t i = 0; i < static_cast<std::size_t>(trail_count_); ++i) {
    go(mesh.toG(trail_[i]));
    focused = focused && inFocus(trail_[i]);
  }
  go(mesh.toG(x));
  mesh.last_x_G = way_[count - 1];
  mesh.clearance -= length;
  if (mesh.clearance > 0 || length == 0) return false;  // the clearance rules out any surface on the path
  MeshFront& around = front(mesh);
  const bool crossed = around.crosses({way_.data(), count}, focused);
  constexpr double kWorthIt = 3;  // number of ticks that computing the clearance should save
  if (!focused || r > kWorthIt * length) mesh.clearance = around.clearance(mesh.last_x_G);
  return crossed;
}

bool Surroundings::full() const noexcept {
  return std::any_of(near_.begin(), near_.begin() + static_cast<std::ptrdiff_t>(near_count_),
                     [&](const Mesh* mesh) { return mesh->covers[point_] && mesh->fronts[point_].full(); });
}

bool Surroundings::crowded() const noexcept {
  bool full = false;
  for (std::size_t m = 0; m < near_count_; ++m) {
    const Mesh& mesh = *near_[m];
    for (std::size_t point = 0; point < 2; ++point) full = full || (mesh.covers[point] && mesh.fronts[point].full());
  }
  return no_room_ || full;
}

}  // namespace presa
