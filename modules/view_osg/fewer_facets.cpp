#include "modules/view_osg/fewer_facets.h"

#include "framework/geometry/decimate.h"

namespace presa::view {
namespace {

constexpr std::size_t kFewestShare = 20;  // at least one triangle of this many stays

}  // namespace

TriMesh fewerFacets(const TriMesh& mesh, double tolerance) {
  return decimateMesh(mesh, mesh.triangles.size() / kFewestShare, tolerance);
}

}  // namespace presa::view
