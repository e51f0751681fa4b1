#include "apps/presa/check/overlap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "framework/geometry/convex.h"
#include "framework/scene/physics_shapes.h"

namespace presa::check {
namespace {

constexpr int kDirections = 300;               // spread over the sphere, before the refinement
constexpr int kStarts = 6;                     // best ones that are refined
constexpr std::size_t kMostVertices = 20'000;  // of a mesh that is looked at: the test of it is quadratic
constexpr double kFinest = 1e-4;               // [rad], the last step of the refinement
constexpr double kFirstStep = 0.1;             // [rad], about the distance of the spread directions

/// A convex shape in the world.
struct Placed {
  const Shape* shape = nullptr;
  const TriMesh* mesh = nullptr;
  Pose X_WG;
  AxisBox box;

  /// Max of n . p over its points [m].
  double reach(const Vec3& n_W) const { return n_W.dot(X_WG.p) + supportOf(*shape, mesh, X_WG.q.inverse() * n_W); }
};

bool isHollow(const PhysicsShape& shape) {
  if (!std::holds_alternative<MeshRef>(*shape.shape)) return false;
  if (shape.mesh == nullptr || shape.mesh->vertices.size() > kMostVertices) return true;
  return !isConvex(*shape.mesh);
}

AxisBox boxOf(const Placed& placed) {
  AxisBox box;
  for (int axis = 0; axis < 3; ++axis) {
    box.high[axis] = placed.reach(Vec3::Unit(axis));
    box.low[axis] = -placed.reach(-Vec3::Unit(axis));
  }
  return box;
}

std::vector<Placed> placedShapes(const Body& body, const BodyMeshes& meshes) {
  std::vector<Placed> placed;
  if (!body.physics) return placed;
  for (const PhysicsShape& shape : physicsShapes(body, meshes)) {
    if (isHollow(shape)) continue;
    Placed one{shape.shape, shape.mesh, body.X_WB * shape.X_BG, {}};
    one.box = boxOf(one);
    placed.push_back(one);
  }
  return placed;
}

bool meet(const AxisBox& a, const AxisBox& b, double tolerance) {
  return (a.high - b.low).minCoeff() > tolerance && (b.high - a.low).minCoeff() > tolerance;
}

/// Fibonacci's spiral.
const std::vector<Vec3>& spreadDirections() {
  static const std::vector<Vec3> all = [] {
    std::vector<Vec3> directions;
    for (int i = 0; i < kDirections; ++i) {
      const double z = 1 - (2 * i + 1.0) / kDirections, turn = i * std::numbers::pi * (3 - std::sqrt(5.0));
      const double r = std::sqrt(1 - z * z);
      directions.emplace_back(r * std::cos(turn), r * std::sin(turn), z);
    }
    return directions;
  }();
  return all;
}

/// Axes of both shapes and the products of them: with boxes, one of these is the shortest way.
std::vector<Vec3> ownDirections(const Placed& a, const Placed& b) {
  std::vector<Vec3> all;
  const Mat3 A = a.X_WG.q.toRotationMatrix(), B = b.X_WG.q.toRotationMatrix();
  for (int i = 0; i < 3; ++i) {
    all.insert(all.end(), {A.col(i), B.col(i)});
    for (int j = 0; j < 3; ++j) {
      const Vec3 across = A.col(i).cross(B.col(j));
      if (across.norm() > 1e-6) all.push_back(across.normalized());
    }
  }
  for (std::size_t i = all.size(); i-- > 0;) all.push_back(-all[i]);
  return all;
}

struct Way {
  double depth = 0;
  Vec3 n = Vec3::UnitZ();
};

/// How far b must move along n to leave a.
Way along(const Placed& a, const Placed& b, const Vec3& n) { return {a.reach(n) + b.reach(-n), n}; }

/// Descends over the sphere to the shortest way near this one.
Way refined(const Placed& a, const Placed& b, Way best) {
  for (double step = kFirstStep; step > kFinest;) {
    const Vec3 u = best.n.unitOrthogonal(), v = best.n.cross(u);
    Way next = best;
    for (int k = 0; k < 8; ++k) {
      const double turn = k * std::numbers::pi / 4;
      const Way tried = along(a, b, (best.n + step * (std::cos(turn) * u + std::sin(turn) * v)).normalized());
      if (tried.depth < next.depth) next = tried;
    }
    if (next.depth < best.depth)
      best = next;
    else
      step /= 2;
  }
  return best;
}

std::optional<Way> overlapOf(const Placed& a, const Placed& b, double tolerance) {
  std::vector<Way> ways;
  for (const std::vector<Vec3>& directions : {ownDirections(a, b), spreadDirections()}) {
    for (const Vec3& n : directions) {
      ways.push_back(along(a, b, n));
      if (ways.back().depth <= tolerance) return std::nullopt;
    }
  }
  const auto starts = ways.begin() + std::min<std::ptrdiff_t>(kStarts, static_cast<std::ptrdiff_t>(ways.size()));
  std::partial_sort(ways.begin(), starts, ways.end(), [](const Way& x, const Way& y) { return x.depth < y.depth; });
  Way best = ways.front();
  for (auto way = ways.begin(); way != starts; ++way) {
    if (const Way found = refined(a, b, *way); found.depth < best.depth) best = found;
    if (best.depth <= tolerance) return std::nullopt;
  }
  return best;
}

/// Whether a joint keeps two bodies from colliding with each other.
bool joined(const Scene& scene, std::size_t a, std::size_t b) {
  return std::ranges::any_of(scene.joints, [&](const Joint& joint) {
    return !joint.collide && ((joint.body == a && joint.to == b) || (joint.body == b && joint.to == a));
  });
}

}  // namespace

std::vector<Overlap> overlapsOf(const World& world, double tolerance) {
  struct Entry {
    std::size_t body = 0;
    Placed placed;
  };
  std::vector<Entry> entries;
  const std::vector<Body>& bodies = world.scene.bodies;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (Placed& placed : placedShapes(bodies[i], world.meshes[i])) entries.push_back({i, std::move(placed)});
  }
  std::ranges::sort(entries, {}, [](const Entry& entry) { return entry.placed.box.low.x(); });
  std::vector<Overlap> overlaps;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    for (std::size_t j = i + 1; j < entries.size(); ++j) {
      const Entry &a = entries[i], &b = entries[j];
      if (b.placed.box.low.x() > a.placed.box.high.x()) break;
      if (a.body == b.body || (bodies[a.body].fixed && bodies[b.body].fixed)) continue;
      if (!meet(a.placed.box, b.placed.box, tolerance) || joined(world.scene, a.body, b.body)) continue;
      const bool in_order = a.body < b.body;
      const Entry &first = in_order ? a : b, &second = in_order ? b : a;
      const auto way = overlapOf(first.placed, second.placed, tolerance);
      if (!way) continue;
      const auto known = std::ranges::find_if(
          overlaps, [&](const Overlap& o) { return o.first == first.body && o.second == second.body; });
      if (known == overlaps.end())
        overlaps.push_back({first.body, second.body, way->depth, way->n});
      else if (way->depth > known->depth)
        *known = {first.body, second.body, way->depth, way->n};
    }
  }
  std::ranges::sort(overlaps, [](const Overlap& x, const Overlap& y) {
    return std::pair(x.first, x.second) < std::pair(y.first, y.second);
  });
  return overlaps;
}

}  // namespace presa::check
