#include "apps/temple/building/ring_stack.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace presa::temple {
namespace {

constexpr double kSameVertex = 1e-9;  // points nearer than this become one vertex [m]

double angleOf(std::size_t i, std::size_t count) {
  return 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
}

}  // namespace

TriMesh stackRings(const std::vector<Ring>& rings, const Vec3& first_center, const Vec3& last_center) {
  TriMesh mesh;
  const std::size_t count = rings.front().size();
  for (const Ring& ring : rings) mesh.vertices.insert(mesh.vertices.end(), ring.begin(), ring.end());
  const auto index = [&](std::size_t ring, std::size_t i) {
    return static_cast<std::int32_t>(ring * count + i % count);
  };
  const auto first = static_cast<std::int32_t>(mesh.vertices.size()), last = first + 1;
  mesh.vertices.push_back(first_center);
  mesh.vertices.push_back(last_center);
  for (std::size_t i = 0; i < count; ++i) {
    mesh.triangles.push_back({first, index(0, i + 1), index(0, i)});
    for (std::size_t ring = 0; ring + 1 < rings.size(); ++ring) {
      mesh.triangles.push_back({index(ring, i), index(ring, i + 1), index(ring + 1, i + 1)});
      mesh.triangles.push_back({index(ring, i), index(ring + 1, i + 1), index(ring + 1, i)});
    }
    mesh.triangles.push_back({last, index(rings.size() - 1, i), index(rings.size() - 1, i + 1)});
  }
  weld(mesh, kSameVertex);
  dropUnused(mesh);
  buildAdjacency(mesh);
  return mesh;
}

void chip(Ring& rim, const Chip& chip, const Vec3& inward) {
  const Vec3 at = rim[chip.at % rim.size()];
  for (Vec3& point : rim) {
    const double part = (point - at).norm() / chip.width;
    if (part < 1) point += chip.depth * (1 - part * part) * inward;
  }
}

Ring withMargins(const Ring& polygon, double margin) {
  Ring ring;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 from = polygon[i], to = polygon[(i + 1) % polygon.size()];
    const double length = (to - from).norm();
    ring.push_back(from);
    if (length <= 3 * margin) continue;
    ring.push_back(from + margin / length * (to - from));
    ring.push_back(to - margin / length * (to - from));
  }
  return ring;
}

Ring scaled(const Ring& ring, const Vec3& center, double factor) {
  Ring result = ring;
  for (Vec3& point : result) point = center + factor * (point - center);
  return result;
}

Ring moved(const Ring& ring, const Vec3& by) {
  Ring result = ring;
  for (Vec3& point : result) point += by;
  return result;
}

Ring circle(double size, double z, std::size_t count) {
  Ring ring(count);
  for (std::size_t i = 0; i < count; ++i)
    ring[i] = {size * std::cos(angleOf(i, count)), size * std::sin(angleOf(i, count)), z};
  return ring;
}

Ring square(double size, double z, std::size_t count) {
  Ring ring = circle(size, z, count);
  for (Vec3& point : ring) {
    const double grow = size / point.head<2>().cwiseAbs().maxCoeff();
    point.head<2>() *= grow;
  }
  return ring;
}

Ring fluted(double size, double z, std::size_t count, int flutes) {
  const std::size_t each = count / static_cast<std::size_t>(flutes);
  const double half_chord = size * std::sin(std::numbers::pi / flutes),
               chord_distance = size * std::cos(std::numbers::pi / flutes);
  const double radius = std::sqrt(2.0) * half_chord;
  Ring ring(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double middle = 2 * std::numbers::pi * (static_cast<double>(i / each) + 0.5) / flutes;
    const double along = std::numbers::pi / 2 * (static_cast<double>(i % each) / static_cast<double>(each) - 0.5);
    // centre of the arc: outside the shaft, half a chord from the chord
    const double out = chord_distance + half_chord - radius * std::cos(along), side = radius * std::sin(along);
    ring[i] = {out * std::cos(middle) - side * std::sin(middle), out * std::sin(middle) + side * std::cos(middle), z};
  }
  return ring;
}

}  // namespace presa::temple
