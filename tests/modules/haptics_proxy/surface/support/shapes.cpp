#include "tests/modules/haptics_proxy/surface/support/shapes.h"

#include <cmath>
#include <map>
#include <utility>

namespace presa::test {
namespace {

using Index = std::int32_t;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// Subdivides the faces of an icosahedron; points on shared edges are created once.
class Icosphere {
 public:
  Icosphere(int n, double radius) : n_(n), radius_(radius) {
    const double g = (1 + std::sqrt(5.0)) / 2;
    for (const Vec3& corner :
         {Vec3(-1, g, 0), Vec3(1, g, 0), Vec3(-1, -g, 0), Vec3(1, -g, 0), Vec3(0, -1, g), Vec3(0, 1, g),
          Vec3(0, -1, -g), Vec3(0, 1, -g), Vec3(g, 0, -1), Vec3(g, 0, 1), Vec3(-g, 0, -1), Vec3(-g, 0, 1)}) {
      corners_.push_back(corner);
      add(corner);
    }
    constexpr Index kFaces[20][3] = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                     {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                     {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                     {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
    for (const auto& face : kFaces) cut(face[0], face[1], face[2]);
  }
  TriMesh mesh;

 private:
  Index add(const Vec3& direction) {
    mesh.vertices.push_back(radius_ * direction.normalized());
    return static_cast<Index>(mesh.vertices.size()) - 1;
  }
  /// Point i of n on the edge from a to b; shared by adjacent faces.
  Index onEdge(Index a, Index b, int i) {
    if (i == 0) return a;
    if (i == n_) return b;
    if (a > b) return onEdge(b, a, n_ - i);
    auto [entry, is_new] = edges_.try_emplace({a, b});
    for (int k = 1; is_new && k < n_; ++k)
      entry->second.push_back(add(corners_[at(a)] + (corners_[at(b)] - corners_[at(a)]) * k / n_));
    return entry->second[at(i - 1)];
  }
  void cut(Index a, Index b, Index c) {
    // row i lies i steps from a towards b, its points j steps towards c
    std::vector<std::vector<Index>> rows;
    for (int i = 0; i <= n_; ++i) {
      rows.emplace_back();
      for (int j = 0; j <= n_ - i; ++j) {
        Index point = 0;
        if (j == 0) {
          point = onEdge(a, b, i);
        } else if (i == 0) {
          point = onEdge(a, c, j);
        } else if (i + j == n_) {
          point = onEdge(b, c, j);
        } else {
          point = add(corners_[at(a)] + (corners_[at(b)] - corners_[at(a)]) * i / n_ +
                      (corners_[at(c)] - corners_[at(a)]) * j / n_);
        }
        rows.back().push_back(point);
      }
    }
    for (int i = 0; i < n_; ++i) {
      for (int j = 0; j < n_ - i; ++j) {
        const std::vector<Index>&row = rows[at(i)], &next = rows[at(i + 1)];
        mesh.triangles.push_back({row[at(j)], next[at(j)], row[at(j + 1)]});
        if (j < n_ - i - 1) mesh.triangles.push_back({next[at(j)], next[at(j + 1)], row[at(j + 1)]});
      }
    }
  }

  int n_;
  double radius_;
  std::vector<Vec3> corners_;
  std::map<std::pair<Index, Index>, std::vector<Index>> edges_;
};

}  // namespace

TriMesh icosphere(int n, double radius) {
  TriMesh mesh = std::move(Icosphere(n, radius).mesh);
  buildAdjacency(mesh);
  return mesh;
}

double facetAngle(int n) {
  constexpr double kLongest = 1.2 * 1.107149;  // an icosahedron's edge subtends atan 2 at its centre
  return kLongest / n / std::sqrt(3.0);        // from the middle of an equilateral facet to its corner
}

TriMesh sheet(double size, int m) {
  TriMesh mesh;
  for (int i = 0; i <= m; ++i) {
    for (int j = 0; j <= m; ++j) mesh.vertices.emplace_back(size * i / m - size / 2, size * j / m - size / 2, 0);
  }
  for (int i = 0; i < m; ++i) {
    for (int j = 0; j < m; ++j) {
      const Index a = i * (m + 1) + j, b = a + m + 1;
      mesh.triangles.push_back({a, b, b + 1});
      mesh.triangles.push_back({a, b + 1, a + 1});
    }
  }
  buildAdjacency(mesh);
  return mesh;
}

TriMesh cutBox(const Vec3& size, int m) {
  const TriMesh square = sheet(1, m);
  TriMesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-0.5, 0.5}) {
      const auto first = static_cast<Index>(mesh.vertices.size());
      for (const Vec3& p : square.vertices) {
        Vec3 vertex;
        // cyclic permutation: a right-handed frame whose third axis is the face's; the opposite face is mirrored
        vertex[axis] = side;
        vertex[(axis + 1) % 3] = side > 0 ? p.x() : -p.x();
        vertex[(axis + 2) % 3] = p.y();
        mesh.vertices.push_back(vertex.cwiseProduct(size));
      }
      for (const TriMesh::Triangle& t : square.triangles)
        mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
  }
  weld(mesh, 0);
  buildAdjacency(mesh);
  return mesh;
}

void append(TriMesh& mesh, const TriMesh& other, const Vec3& offset) {
  const auto first = static_cast<Index>(mesh.vertices.size());
  for (const Vec3& p : other.vertices) mesh.vertices.push_back(p + offset);
  for (const TriMesh::Triangle& t : other.triangles)
    mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

}  // namespace presa::test
