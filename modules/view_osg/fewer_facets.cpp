#include "modules/view_osg/fewer_facets.h"

#include <osg/Geometry>
#include <osg/TriangleIndexFunctor>
#include <osgUtil/Simplifier>

namespace presa::view {
namespace {

constexpr double kUnit = 1000;         // length unit of the simplifier per metre: its errors are single precision
constexpr double kFewestShare = 0.05;  // minimum fraction of triangles to keep

struct Collector {
  std::vector<TriMesh::Triangle> triangles;
  void operator()(unsigned a, unsigned b, unsigned c) {
    triangles.push_back({static_cast<std::int32_t>(a), static_cast<std::int32_t>(b), static_cast<std::int32_t>(c)});
  }
};

}  // namespace

TriMesh fewerFacets(const TriMesh& mesh, double tolerance) {
  osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
  osg::ref_ptr<osg::Vec3Array> positions = new osg::Vec3Array;
  for (const Vec3& p : mesh.vertices) positions->push_back(osg::Vec3d(kUnit * p.x(), kUnit * p.y(), kUnit * p.z()));
  osg::ref_ptr<osg::DrawElementsUInt> triangles = new osg::DrawElementsUInt(osg::PrimitiveSet::TRIANGLES);
  for (const TriMesh::Triangle& triangle : mesh.triangles)
    for (const std::int32_t corner : triangle) triangles->push_back(static_cast<unsigned>(corner));
  geometry->setVertexArray(positions);
  geometry->addPrimitiveSet(triangles);

  osgUtil::Simplifier simplifier(kFewestShare, kUnit * tolerance);
  simplifier.setDoTriStrip(false);
  simplifier.setSmoothing(false);
  simplifier.simplify(*geometry);

  TriMesh fewer;
  for (const osg::Vec3& p : static_cast<const osg::Vec3Array&>(*geometry->getVertexArray()))
    fewer.vertices.push_back(Vec3(p.x(), p.y(), p.z()) / kUnit);
  osg::TriangleIndexFunctor<Collector> collector;
  geometry->accept(collector);
  fewer.triangles = std::move(collector.triangles);
  return fewer;
}

}  // namespace presa::view
