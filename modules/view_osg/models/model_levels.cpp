#include "modules/view_osg/models/model_levels.h"

#include <algorithm>
#include <cmath>

#include "framework/geometry/decimate.h"
#include "framework/geometry/surface_tree.h"

namespace presa::view {
namespace {

constexpr std::size_t kFewTriangles = 2000;  ///< as coarse as a level becomes
constexpr std::size_t kQuarter = 4;
constexpr double kUseful = 0.7;     ///< a level with more triangles than this share of the one before saves nothing
constexpr double kCoarsest = 0.02;  ///< max error of a level, relative to the model's size
constexpr std::size_t kMeasured = 20'000;  ///< vertices from which the error of a level is measured
constexpr double kColorBump = 0.01;        ///< from black to white, relative to the model's size

using Vec3f = Eigen::Vector3f;

bool isColored(const ModelVertex& v) { return v.color != std::array<float, 3>{1, 1, 1}; }

double sizeOf(const ModelSurface& surface) {
  Vec3f low = Vec3f::Constant(1e30F), high = -low;
  for (const ModelVertex& v : surface.vertices) {
    const Vec3f p(v.position[0], v.position[1], v.position[2]);
    low = low.cwiseMin(p), high = high.cwiseMax(p);
  }
  return double{(high - low).norm()};
}

/// Where each vertex is for the decimation: at its place, raised along the mean normal of that place by its colour.
std::vector<float> placesFor(const ModelSurface& surface, double size) {
  std::vector<float> places;
  places.reserve(3 * surface.vertices.size());
  for (const ModelVertex& v : surface.vertices) places.insert(places.end(), v.position.begin(), v.position.end());
  if (std::ranges::none_of(surface.vertices, isColored)) return places;
  const std::vector<std::uint32_t> same = placesOf(surface.vertices);
  std::vector<Vec3f> normal(surface.vertices.size(), Vec3f::Zero());
  std::vector<float> light(surface.vertices.size(), 0), count(surface.vertices.size(), 0);
  for (std::size_t v = 0; v < same.size(); ++v) {
    const ModelVertex& vertex = surface.vertices[v];
    normal[same[v]] += Vec3f(vertex.normal[0], vertex.normal[1], vertex.normal[2]);
    light[same[v]] += (vertex.color[0] + vertex.color[1] + vertex.color[2]) / 3;
    ++count[same[v]];
  }
  for (std::size_t v = 0; v < same.size(); ++v) {
    const std::uint32_t at = same[v];
    const Vec3f bump = static_cast<float>(kColorBump * size) * light[at] / count[at] * normal[at].normalized();
    for (int i = 0; i < 3; ++i) places[3 * v + static_cast<std::size_t>(i)] += bump[i];
  }
  return places;
}

ModelLevel byParts(const ModelSurface& surface, const std::vector<std::uint32_t>& corners, double error) {
  ModelLevel level{std::vector<std::vector<std::uint32_t>>(surface.parts.size()), corners.size() / 3, error};
  for (std::size_t c = 0; c + 2 < corners.size(); c += 3) {
    const auto behind = std::ranges::upper_bound(surface.parts, corners[c], {}, &Model::Part::first_vertex);
    std::vector<std::uint32_t>& part = level.corners[static_cast<std::size_t>(behind - surface.parts.begin()) - 1];
    part.insert(part.end(), {corners[c], corners[c + 1], corners[c + 2]});
  }
  return level;
}

/// How far a level is from the finest [m]: the largest distance of its vertices, a sample where they are many. What the
/// decimation tells is a mean, up to seven times less.
double errorOf(const ModelSurface& surface, const std::vector<std::uint32_t>& corners) {
  const auto at = [&](std::size_t v) {
    const std::array<float, 3>& p = surface.vertices[v].position;
    return Vec3(p[0], p[1], p[2]);
  };
  TriMesh mesh;
  for (std::size_t v = 0; v < surface.vertices.size(); ++v) mesh.vertices.push_back(at(v));
  for (std::size_t c = 0; c + 2 < corners.size(); c += 3) {
    const auto corner = [&](std::size_t i) { return static_cast<std::int32_t>(corners[c + i]); };
    mesh.triangles.push_back({corner(0), corner(1), corner(2)});
  }
  const SurfaceTree tree(mesh);
  double largest = 0;  // squared
  for (std::size_t v = 0; v < mesh.vertices.size(); v += 1 + mesh.vertices.size() / kMeasured)
    largest = std::max(largest, tree.squaredDistance(mesh.vertices[v], 1e300));
  return std::sqrt(largest);
}

}  // namespace

std::vector<ModelLevel> levelsOf(const ModelSurface& surface) {
  std::vector<ModelLevel> levels{byParts(surface, surface.corners, 0)};
  const double size = sizeOf(surface);
  const std::vector<float> places = placesFor(surface, size);
  std::vector<std::uint32_t> corners = surface.corners;
  while (corners.size() / 3 > kFewTriangles) {
    const std::size_t before = corners.size();
    CoarserCorners coarser = decimateCorners(places, corners, before / 3 / kQuarter, kCoarsest * size);
    if (static_cast<double>(coarser.corners.size()) > kUseful * static_cast<double>(before)) break;
    corners = std::move(coarser.corners);
    // bumps of colours count, too: only the decimation knows them
    const double error = std::max({errorOf(surface, corners), coarser.error, levels.back().error});
    levels.push_back(byParts(surface, corners, error));
  }
  return levels;
}

}  // namespace presa::view
