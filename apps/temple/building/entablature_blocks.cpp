#include "apps/temple/building/entablature_blocks.h"

#include <algorithm>
#include <cmath>

#include "apps/temple/building/ring_stack.h"

namespace presa::temple {
namespace {

using Polygon = std::vector<Eigen::Vector2d>;

/// A counter-clockwise polygon in the plane (u, v), extruded along w = u x v by `length` [m].
struct Extrusion {
  Vec3 u, v, w;
  Polygon polygon;
  Eigen::Vector2d center;  ///< the polygon is star-shaped about it
  double length = 0;
};
const Vec3 kX = Vec3::UnitX(), kY = Vec3::UnitY(), kZ = Vec3::UnitZ();
constexpr double kInset = 0.85;  // scale of the inner part of an end face, which chips leave unchanged

double cutMargin(const Proportions& p) { return 1.5 * p.stone.chip_depth; }
/// Half the depth of architrave and frieze [m].
double halfDepth(const Proportions& p) { return 0.5 * p.entablature->depth * p.module; }
/// Half the depth of the cornices [m].
double halfCornice(const Proportions& p) { return halfDepth(p) + p.entablature->cornice_projection * p.module; }

/// Chips random corners of the two end faces, each corner at most once.
void breakCorners(const Proportions& p, const Ring& corners, Ring& first, Ring& last, const Vec3& w, const Vec3& center,
                  RandomStream& random) {
  std::vector<std::size_t> free(2 * corners.size());
  for (std::size_t i = 0; i < free.size(); ++i) free[i] = i;
  random.shuffle(std::span(free));
  for (std::size_t i = 0; i < std::min(free.size(), static_cast<std::size_t>(p.stone.chips)); ++i) {
    const bool at_first = free[i] < corners.size();
    const Vec3 corner = corners[free[i] % corners.size()];
    Ring& rim = at_first ? first : last;
    const auto along = [&](const Vec3& point) { return (point - corner) - (point - corner).dot(w) * w; };
    const auto nearer = [&](const Vec3& a, const Vec3& b) { return along(a).squaredNorm() < along(b).squaredNorm(); };
    const auto at = static_cast<std::size_t>(std::min_element(rim.begin(), rim.end(), nearer) - rim.begin());
    Vec3 inward = center - corner;
    inward = (inward - inward.dot(w) * w).normalized() + (at_first ? w : Vec3(-w));
    chip(rim, {at, 1.4 * cutMargin(p), p.stone.chip_depth * random.uniform(0.6, 1.0)}, inward.normalized());
  }
}

TriMesh extrude(const Proportions& p, const Extrusion& shape, RandomStream random) {
  const double margin = cutMargin(p);
  Ring corners;
  for (const Eigen::Vector2d& point : shape.polygon) corners.push_back(point.x() * shape.u + point.y() * shape.v);
  const Ring line = withMargins(corners, margin);
  const Vec3 center = shape.center.x() * shape.u + shape.center.y() * shape.v;
  const Vec3 end = shape.length / 2 * shape.w, step = margin * shape.w;
  Ring first = moved(line, -end), last = moved(line, end);
  const Ring first_inset = scaled(first, center - end, kInset), last_inset = scaled(last, center + end, kInset);
  breakCorners(p, corners, first, last, shape.w, center, random);
  return stackRings({first_inset, first, moved(line, step - end), moved(line, end - step), last, last_inset},
                    center - end, center + end);
}

Block blockOf(BlockKind kind, TriMesh mesh, const Vec3& size) {
  Block block;
  block.kind = kind;
  block.physics = Box{size};
  block.haptic = mesh;
  block.visual = std::move(mesh);
  return block;
}

/// A T profile, a bar over a stem, in (y, z) relative to the middle of its bounding box [m].
Polygon tee(double half_stem, double half_bar, double height, double bar) {
  const double bottom = -height / 2, step = height / 2 - bar, top = height / 2;
  return {{half_stem, bottom}, {half_stem, step}, {half_bar, step},   {half_bar, top},
          {-half_bar, top},    {-half_bar, step}, {-half_stem, step}, {-half_stem, bottom}};
}

/// Profile of a triglyph's channels from its left to its right edge, as points (x, depth) [m]. Of six parts, three
/// femora and two channels between them take one each and two half channels at the edges a half each; the channels are
/// cut with the tip of a square [Vitruvius IV.3.5].
std::vector<Eigen::Vector2d> channels(double width) {
  const double part = width / 6;
  std::vector<Eigen::Vector2d> line;
  for (const auto& [x, depth] : {std::pair{-3.0, 0.5},
                                 {-2.5, 0.0},
                                 {-1.5, 0.0},
                                 {-1.0, 0.5},
                                 {-0.5, 0.0},
                                 {0.5, 0.0},
                                 {1.0, 0.5},
                                 {1.5, 0.0},
                                 {2.5, 0.0},
                                 {3.0, 0.5}})
    line.emplace_back(x * part, depth * part);
  return line;
}

double metopeRecess(const Proportions& p) { return p.entablature->triglyph_width * p.module / 12; }

/// Plan of a triglyph, with equal front and rear faces. `cut`: with the channels; otherwise with flat faces, as in the
/// band above them.
Ring triglyphPlan(const Proportions& p, double left, double right, double axis, bool cut) {
  const double half = halfDepth(p);
  std::vector<Eigen::Vector2d> face = channels(p.entablature->triglyph_width * p.module);
  for (Eigen::Vector2d& point : face) point.x() += axis;
  // a half metope lies as deep as the edge of the half channel
  if (left < face.front().x() - 1e-9) face.insert(face.begin(), {left, metopeRecess(p)});
  if (right > face.back().x() + 1e-9) face.push_back({right, metopeRecess(p)});
  Ring ring;
  for (const Eigen::Vector2d& point : face) ring.push_back({point.x(), -half + (cut ? point.y() : 0), 0});
  for (auto point = face.rbegin(); point != face.rend(); ++point)
    ring.push_back({point->x(), half - (cut ? point->y() : 0), 0});
  return ring;
}

}  // namespace

Block makeArchitrave(const Proportions& p, double length, RandomStream chips) {
  const double height = p.entablature->architrave_height * p.module, taenia = p.entablature->taenia_height * p.module;
  const double half = halfDepth(p), stem = half - 0.06 * p.module;
  const Extrusion shape{kY, kZ, kX, tee(stem, half, height, taenia), {0, (height - taenia) / 2}, length};
  return blockOf(BlockKind::kArchitrave, extrude(p, shape, chips), {length, 2 * half, height});
}

Block makeTriglyph(const Proportions& p, double half_metope, RandomStream chips) {
  const double width = p.entablature->triglyph_width * p.module, joint = p.stone.joint / 2;
  const double total = width + std::abs(half_metope), axis = -half_metope / 2;
  // a corner block has no joint on the side of its half metope
  const double left = -total / 2 + (half_metope < 0 ? 0 : joint), right = total / 2 - (half_metope > 0 ? 0 : joint);
  const double height = (p.entablature->frieze_height + p.entablature->band_height) * p.module;
  const double band = p.entablature->band_height * p.module, margin = cutMargin(p);
  const auto at = [&](bool cut, double z) {
    Ring ring = triglyphPlan(p, left, right, axis, cut);
    for (Vec3& point : ring) {
      point.x() = std::clamp(point.x(), left, right);
      point.z() = z;
    }
    return ring;
  };
  Ring first = at(true, -height / 2), last = at(false, height / 2);
  const Vec3 below(axis, 0, -height / 2), above(axis, 0, height / 2);
  const Ring first_inset = scaled(first, below, kInset), last_inset = scaled(last, above, kInset);
  const double y = halfDepth(p);
  breakCorners(p, {{left, -y, 0}, {right, -y, 0}, {right, y, 0}, {left, y, 0}}, first, last, kZ, {axis, 0, 0}, chips);
  // the channels end below the band in a slope as steep as their sides
  const double under_band = height / 2 - band - metopeRecess(p);
  TriMesh mesh = stackRings({first_inset, first, at(true, -height / 2 + margin), at(true, under_band),
                             at(false, under_band + metopeRecess(p)), at(false, height / 2 - margin), last, last_inset},
                            below, above);
  // move the origin to the middle of the physics box
  const Vec3 shift((left + right) / 2, 0, 0);
  for (Vec3& vertex : mesh.vertices) vertex -= shift;
  return blockOf(BlockKind::kTriglyph, std::move(mesh), {right - left, 2 * y, height});
}

Block makeMetope(const Proportions& p, RandomStream chips) {
  const double width = p.entablature->metope_width * p.module - p.stone.joint;
  const double height = (p.entablature->frieze_height + p.entablature->band_height) * p.module;
  const double band = p.entablature->band_height * p.module, half = halfDepth(p);
  const Extrusion shape{kY, kZ, kX, tee(half - metopeRecess(p), half, height, band), {0, (height - band) / 2}, width};
  return blockOf(BlockKind::kMetope, extrude(p, shape, chips), {width, 2 * half, height});
}

Block makeCornice(const Proportions& p, double length, RandomStream chips) {
  const double height = p.entablature->cornice_height * p.module, bar = 0.7 * height;
  const Extrusion shape{
      kY, kZ, kX, tee(halfDepth(p) + 0.15 * p.module, halfCornice(p), height, bar), {0, (height - bar) / 2}, length};
  return blockOf(BlockKind::kCornice, extrude(p, shape, chips), {length, 2 * halfCornice(p), height});
}

Block makeTympanum(const Proportions& p, double length, double left, double right, RandomStream chips) {
  const double middle = std::max(left, right) / 2, half = length / 2;
  const Polygon wedge{{-half, -middle}, {half, -middle}, {half, right - middle}, {-half, left - middle}};
  const Eigen::Vector2d center = (wedge[0] + wedge[1] + wedge[2] + wedge[3]) / 4;
  const double depth = 2 * halfDepth(p);
  Block block = blockOf(BlockKind::kTympanum, extrude(p, {kX, kZ, -kY, wedge, center, depth}, chips), Vec3::Ones());
  block.physics = MeshRef{};
  Ring front, back;
  for (const Eigen::Vector2d& corner : wedge) {
    front.push_back({corner.x(), depth / 2, corner.y()});
    back.push_back({corner.x(), -depth / 2, corner.y()});
  }
  const Vec3 between(center.x(), 0, center.y());
  block.physics_mesh = stackRings({front, back}, between + depth / 2 * kY, between - depth / 2 * kY);
  return block;
}

Block makeRakingCornice(const Proportions& p, double length, RandomStream chips) {
  const double height = p.pediment->raking_height * p.module, half = halfCornice(p);
  // the profile narrows downwards: its sides lean
  const double lean = 0.3 * height;
  const Polygon profile{
      {half - lean, -height / 2}, {half, height / 2}, {-half, height / 2}, {-half + lean, -height / 2}};
  return blockOf(BlockKind::kRakingCornice, extrude(p, {kY, kZ, kX, profile, {0, 0}, length}, chips),
                 {length, 2 * half, height});
}

Block makeTile(const Proportions& p, double length, RandomStream chips) {
  const double height = p.pediment->tile_height * p.module, half = halfCornice(p);
  // side faces are vertical for most of the height: from lower ones fingertips near the ground slip off upwards
  const double edge = 0.3 * height;
  const Polygon profile{{half, -height / 2},       {half, edge},  {0.8 * half, height / 2},
                        {-0.8 * half, height / 2}, {-half, edge}, {-half, -height / 2}};
  return blockOf(BlockKind::kTile, extrude(p, {kY, kZ, kX, profile, {0, 0}, length}, chips),
                 {length, 2 * half, height});
}

void mitre(Block& block, int end, double slope) {
  const Vec3 half = std::get<Box>(block.physics).size / 2;
  for (TriMesh* mesh : {&block.visual, &block.haptic}) {
    for (Vec3& vertex : mesh->vertices)
      if (end * vertex.x() > 0) vertex.x() += end * slope * (vertex.z() + half.z());
  }
}

}  // namespace presa::temple
