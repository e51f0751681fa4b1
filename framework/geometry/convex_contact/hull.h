#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "framework/core/math/spatial.h"
#include "framework/geometry/tri_mesh.h"

namespace presa {

/// A convex polyhedron, widened by `radius` on all sides. A capsule is a segment with a radius, a sphere a point. All in one
/// frame, which the functions below name [m]. Thread: before a run, except for place().
struct Hull {
  /// A flat side.
  struct Face {
    Vec3 nhat = Vec3::Zero();        ///< outward
    double offset = 0;               ///< nhat . p of its points
    std::vector<std::int32_t> loop;  ///< vertices, counter-clockwise from outside
  };
  /// Where two faces meet, or a segment.
  struct Edge {
    std::int32_t from = 0,       ///< a vertex
        to = 0;                  ///< the other one
    std::int32_t left = -1,      ///< a face; -1: none (segment)
        right = -1;              ///< the other one; -1: none
    std::int32_t direction = 0;  ///< index into `directions`, up to sign
  };
  std::vector<Vec3> vertices;    ///< corners; one: a point, two: a segment
  std::vector<Face> faces;       ///< none: a point or a segment
  std::vector<Edge> edges;       ///< of all faces, each once; of a segment, itself
  std::vector<Vec3> directions;  ///< of edges, unit, parallel ones once
  Vec3 centre = Vec3::Zero();    ///< mean of the vertices
  double radius = 0;             ///< of the widening [m]
  /// The cylinder that a prism stands for, along z.
  struct Cylinder {
    double radius,  ///< [m]
        length;     ///< between the flat ends [m]
  };
  std::optional<Cylinder> cylinder;  ///< the polyhedron is a prism in this cylinder (cylinder.h)
};

/// `loops`: the corners of each face, counter-clockwise from outside. Their planes must be convex.
Hull polyhedron(const std::vector<Vec3>& corners, const std::vector<std::vector<std::int32_t>>& loops);

Hull boxHull(const Vec3& size);  ///< centred; edge lengths [m]
Hull sphereHull(double radius);  ///< centred [m]
/// Along z, like Presa's capsules: `length` between the centres of its ends [m].
Hull capsuleHull(double radius, double length);
/// A pair costs the product of their edges: a mesh with more faces is no hull.
constexpr std::size_t kMaxMeshFaces = 64;
/// The faces of a convex mesh, coplanar triangles merged; none when the mesh is not closed and convex within
/// `tolerance` of its size, or has more than `max_faces` faces.
std::optional<Hull> meshHull(const TriMesh& mesh, double tolerance = 1e-5, std::size_t max_faces = kMaxMeshFaces);

/// `hull` at pose X_WH, in W. Nonblocking if `out` held a copy of the same hull before. Thread: any.
void place(const Hull& hull, const Pose& X_WH, Hull& out);

}  // namespace presa
