#include "devices/percro_arm/drawn_shapes.h"

#include <cmath>
#include <numbers>

namespace presa::percro {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr int kPieces = 48;   // of a whole turn
constexpr int kSection = 10;  // of a round section

}  // namespace

std::shared_ptr<const TriMesh> revolved(const std::vector<ProfileCorner>& outline, double from, double to) {
  auto mesh = std::make_shared<TriMesh>();
  const bool whole = to - from > kTurn - 1e-9;
  const int steps = std::max(2, static_cast<int>(std::ceil(kPieces * (to - from) / kTurn)));
  const int rows = whole ? steps : steps + 1, around = static_cast<int>(outline.size());
  for (int row = 0; row < rows; ++row) {
    const double angle = from + (to - from) * row / steps;
    for (const auto& [r, z] : outline) mesh->vertices.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
  }
  for (int row = 0; row < steps; ++row) {
    for (int i = 0; i < around; ++i) {
      const int here = row * around, there = (row + 1) % rows * around, next = (i + 1) % around;
      mesh->triangles.push_back({here + i, there + next, there + i});
      mesh->triangles.push_back({here + i, here + next, there + next});
    }
  }
  for (int i = 1; !whole && i + 1 < around; ++i) {  // the outline is convex where it has ends
    const int last = steps * around;
    mesh->triangles.push_back({0, i + 1, i});
    mesh->triangles.push_back({last, last + i, last + i + 1});
  }
  if (massProperties(*mesh).volume < 0) turnInsideOut(*mesh);
  buildAdjacency(*mesh);
  return mesh;
}

std::shared_ptr<const TriMesh> revolved(const std::vector<ProfileCorner>& outline) {
  return revolved(outline, 0, kTurn);
}

std::shared_ptr<const TriMesh> bow(double radius, double thickness, double from, double to) {
  std::vector<ProfileCorner> outline;
  for (int i = 0; i < kSection; ++i) {
    const double angle = kTurn * i / kSection;
    outline.push_back({radius + thickness * std::cos(angle), thickness * std::sin(angle)});
  }
  return revolved(outline, from, to);
}

std::shared_ptr<const TriMesh> tube(double inner, double outer, double length) {
  const double half = length / 2;
  return revolved({{inner, -half}, {outer, -half}, {outer, half}, {inner, half}});
}

}  // namespace presa::percro
