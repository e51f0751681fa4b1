#include "modules/view_osg/geometry_nodes.h"

#include <cmath>
#include <numbers>

#include "modules/view_osg/osg_convert.h"

namespace presa::view {
namespace {

osg::ref_ptr<osg::Geometry> assemble(osg::Vec3Array* positions, osg::Vec3Array* normals,
                                     osg::DrawElementsUInt* triangles, const Vec3& color) {
  osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
  geometry->setUseDisplayList(false);
  geometry->setUseVertexBufferObjects(true);
  geometry->setVertexArray(positions);
  geometry->setNormalArray(normals, osg::Array::BIND_PER_VERTEX);
  osg::ref_ptr<osg::Vec4Array> colors = new osg::Vec4Array;
  colors->push_back(osg::Vec4(osg::Vec3(toOsg(color)), 1));
  geometry->setColorArray(colors, osg::Array::BIND_OVERALL);
  geometry->addPrimitiveSet(triangles);
  return geometry;
}

/// Quarter circle about (0, z_center) from `from` to `to` [rad], angle measured from the xy plane.
void appendArc(std::vector<ProfilePoint>& profile, double radius, double z_center, double from, double to, int pieces) {
  for (int i = 0; i <= pieces; ++i) {
    const double angle = from + (to - from) * i / pieces;
    const double c = std::cos(angle), s = std::sin(angle);
    profile.push_back({radius * c, z_center + radius * s, c, s});
  }
}

}  // namespace

osg::ref_ptr<osg::Geometry> revolve(const std::vector<ProfilePoint>& profile, const Vec3& color,
                                    const Roundness& round) {
  osg::ref_ptr<osg::Vec3Array> positions = new osg::Vec3Array;
  osg::ref_ptr<osg::Vec3Array> normals = new osg::Vec3Array;
  osg::ref_ptr<osg::DrawElementsUInt> triangles = new osg::DrawElementsUInt(osg::PrimitiveSet::TRIANGLES);
  for (const ProfilePoint& point : profile) {
    for (int i = 0; i <= round.around; ++i) {
      const double turn = 2 * std::numbers::pi * (i % round.around) / round.around;
      const double c = std::cos(turn), s = std::sin(turn);
      positions->push_back(osg::Vec3d(point.r * c, point.r * s, point.z));
      normals->push_back(osg::Vec3d(point.nr * c, point.nr * s, point.nz));
    }
  }
  const auto around = static_cast<unsigned>(round.around), row_length = around + 1;
  for (unsigned row = 0; row + 1 < profile.size(); ++row) {
    for (unsigned i = 0; i < around; ++i) {
      const unsigned low = row * row_length + i, high = low + row_length;
      for (const unsigned corner : {low, low + 1, high + 1, low, high + 1, high}) triangles->push_back(corner);
    }
  }
  return assemble(positions, normals, triangles, color);
}

osg::ref_ptr<osg::Geometry> boxGeometry(const Vec3& size, const Vec3& color) {
  osg::ref_ptr<osg::Vec3Array> positions = new osg::Vec3Array;
  osg::ref_ptr<osg::Vec3Array> normals = new osg::Vec3Array;
  osg::ref_ptr<osg::DrawElementsUInt> triangles = new osg::DrawElementsUInt(osg::PrimitiveSet::TRIANGLES);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const unsigned first = positions->size();
      const Vec3 normal = side * Vec3::Unit(axis);
      const Vec3 u = Vec3::Unit((axis + 1) % 3), v = normal.cross(u);
      for (const auto& [a, b] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
        const Vec3 p = 0.5 * size.cwiseProduct(normal + a * u + b * v);
        positions->push_back(toOsg(p));
        normals->push_back(toOsg(normal));
      }
      for (const unsigned corner : {0U, 1U, 2U, 0U, 2U, 3U}) triangles->push_back(first + corner);
    }
  }
  return assemble(positions, normals, triangles, color);
}

osg::ref_ptr<osg::Geometry> sphereGeometry(double radius, const Vec3& color, const Roundness& round) {
  return capsuleGeometry(radius, 0, color, round);
}

osg::ref_ptr<osg::Geometry> cylinderGeometry(double radius, double length, const Vec3& color, const Roundness& round) {
  const double half = length / 2;
  return revolve({{0, -half, 0, -1},
                  {radius, -half, 0, -1},
                  {radius, -half, 1, 0},
                  {radius, half, 1, 0},
                  {radius, half, 0, 1},
                  {0, half, 0, 1}},
                 color, round);
}

osg::ref_ptr<osg::Geometry> capsuleGeometry(double radius, double length, const Vec3& color, const Roundness& round) {
  constexpr double kRight = std::numbers::pi / 2;
  std::vector<ProfilePoint> profile;
  appendArc(profile, radius, -length / 2, -kRight, 0, round.arc);
  appendArc(profile, radius, length / 2, 0, kRight, round.arc);
  return revolve(profile, color, round);
}

osg::ref_ptr<osg::Geometry> meshGeometry(const ShadedMesh& mesh, const Vec3& color) {
  osg::ref_ptr<osg::Vec3Array> positions = new osg::Vec3Array;
  osg::ref_ptr<osg::Vec3Array> normals = new osg::Vec3Array;
  for (const auto& p : mesh.positions) positions->push_back(osg::Vec3(p.x(), p.y(), p.z()));
  for (const auto& n : mesh.normals) normals->push_back(osg::Vec3(n.x(), n.y(), n.z()));
  osg::ref_ptr<osg::DrawElementsUInt> triangles =
      new osg::DrawElementsUInt(osg::PrimitiveSet::TRIANGLES, mesh.indices.begin(), mesh.indices.end());
  return assemble(positions, normals, triangles, color);
}

osg::ref_ptr<osg::Geometry> unitShaft(const Vec3& color, const Roundness& round) {
  return revolve({{0, 0, 0, -1}, {1, 0, 0, -1}, {1, 0, 1, 0}, {1, 1, 1, 0}, {1, 1, 0, 1}, {0, 1, 0, 1}}, color, round);
}

osg::ref_ptr<osg::Geometry> unitConeUp(const Vec3& color, const Roundness& round) {
  const double n = std::numbers::sqrt2 / 2;
  return revolve({{0, 0, 0, -1}, {1, 0, 0, -1}, {1, 0, n, n}, {0, 1, n, n}}, color, round);
}

osg::ref_ptr<osg::Geometry> unitFrictionCone(const Vec3& color, const Roundness& round) {
  const double n = std::numbers::sqrt2 / 2;
  return revolve({{0, 0, n, -n}, {1, 1, n, -n}}, color, round);
}

osg::ref_ptr<osg::Geometry> unitRim(const Vec3& color, const Roundness& round) {
  // a thin band: unlike GL lines it has the same width on every driver
  return revolve({{0.985, 0.985, 0, -1}, {1, 1, 0, -1}}, color, round);
}

}  // namespace presa::view
