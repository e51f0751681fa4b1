#include "tests/modules/haptics_proxy/surface/support/hard_meshes.h"

#include <algorithm>
#include <random>

#include "tests/modules/haptics_proxy/surface/support/shapes.h"

namespace presa::test {
namespace {

using Index = std::int32_t;

double uniform(std::mt19937_64& random, double from, double to) {
  return std::uniform_real_distribution<double>(from, to)(random);
}
Vec3 somewhere(std::mt19937_64& random, double half) {
  const double x = uniform(random, -half, half), y = uniform(random, -half, half), z = uniform(random, -half, half);
  return {x, y, z};
}

Index add(TriMesh& mesh, const Vec3& p) {
  mesh.vertices.push_back(p);
  return static_cast<Index>(mesh.vertices.size()) - 1;
}

/// Tetrahedra 80 mm long and 20 um thick, in all directions.
TriMesh needles() {
  std::mt19937_64 random(1);
  TriMesh mesh;
  for (int i = 0; i < 60; ++i) {
    const Vec3 from = somewhere(random, 0.04), way = somewhere(random, 1).normalized(),
               side = 20e-6 * way.unitOrthogonal();
    const Index a = add(mesh, from), b = add(mesh, from + side), c = add(mesh, from + way.cross(side)),
                tip = add(mesh, from + 0.08 * way);
    for (const TriMesh::Triangle& t : {TriMesh::Triangle{a, c, b}, {a, b, tip}, {b, c, tip}, {c, a, tip}})
      mesh.triangles.push_back(t);
  }
  return mesh;
}

/// A sheet of triangles 100 mm long and 25 um wide, and others on its surface with corners collinear to within 1 nm.
TriMesh slivers() {
  std::mt19937_64 random(2);
  TriMesh mesh;
  constexpr int kCount = 4000;
  for (int i = 0; i <= kCount; ++i) {
    for (const double y : {-0.05, 0.05}) add(mesh, {0.1 * i / kCount - 0.05, y, 0});
  }
  for (Index i = 0; i < kCount; ++i) {
    mesh.triangles.push_back({2 * i, 2 * i + 2, 2 * i + 1});
    mesh.triangles.push_back({2 * i + 2, 2 * i + 3, 2 * i + 1});
  }
  for (int i = 0; i < 500; ++i) {
    const Vec3 from(uniform(random, -0.05, 0.05), uniform(random, -0.05, 0.05), 0),
        to(uniform(random, -0.05, 0.05), uniform(random, -0.05, 0.05), 0);
    mesh.triangles.push_back({add(mesh, from), add(mesh, to), add(mesh, 0.3 * from + 0.7 * to + Vec3(1e-9, 0, 1e-9))});
  }
  return mesh;
}

/// Triangles without area: a repeated vertex, three collinear vertices, three coincident vertices.
TriMesh withoutArea() {
  TriMesh mesh = icosphere(8, 0.05);
  const std::size_t count = mesh.triangles.size();
  for (std::size_t t = 0; t < count; t += 3) {
    const TriMesh::Triangle at = mesh.triangles[t];
    const Index middle = add(
        mesh, (mesh.vertices[static_cast<std::size_t>(at[0])] + mesh.vertices[static_cast<std::size_t>(at[1])]) / 2);
    mesh.triangles.push_back({at[0], at[1], at[1]});
    mesh.triangles.push_back({at[0], middle, at[1]});
    mesh.triangles.push_back({at[2], at[2], at[2]});
  }
  return mesh;
}

TriMesh duplicated() {
  TriMesh mesh = icosphere(16, 0.05);
  const std::vector<TriMesh::Triangle> once = mesh.triangles;
  mesh.triangles.insert(mesh.triangles.end(), once.begin(), once.end());
  return mesh;
}

TriMesh inverted() {
  TriMesh mesh = icosphere(16, 0.05);
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) std::swap(mesh.triangles[t][0], mesh.triangles[t][1]);
  return mesh;
}

/// A box whose halves are tessellated differently and share no vertices: 7 x 7 on 5 x 5.
TriMesh tJunctions() {
  TriMesh mesh;
  append(mesh, cutBox({0.1, 0.1, 0.05}, 7), {0, 0, 0.025});
  append(mesh, cutBox({0.1, 0.1, 0.05}, 5), {0, 0, -0.025});
  // removing the two faces in the middle leaves one box with T-junctions round its waist
  std::erase_if(mesh.triangles, [&](const TriMesh::Triangle& t) {
    return std::ranges::all_of(
        t, [&](Index v) { return std::abs(mesh.vertices[static_cast<std::size_t>(v)].z()) < 1e-9; });
  });
  return mesh;
}

TriMesh openShell() {
  TriMesh mesh = icosphere(24, 0.05);
  std::erase_if(mesh.triangles, [&](const TriMesh::Triangle& t) {
    return std::ranges::any_of(t, [&](Index v) { return mesh.vertices[static_cast<std::size_t>(v)].z() > 0.01; });
  });
  return mesh;
}

TriMesh selfIntersecting() {
  TriMesh mesh = icosphere(12, 0.04);
  append(mesh, icosphere(10, 0.03), {0.03, 0, 0});
  append(mesh, cutBox({0.06, 0.02, 0.09}, 3), {0, 0.02, 0});
  return mesh;
}

TriMesh noise() {
  std::mt19937_64 random(3);
  TriMesh mesh = icosphere(20, 0.05);
  for (Vec3& p : mesh.vertices) p += somewhere(random, 0.004);
  return mesh;
}

TriMesh soup() {
  std::mt19937_64 random(4);
  TriMesh mesh;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 at = somewhere(random, 0.05);
    const Index a = add(mesh, at), b = add(mesh, at + somewhere(random, 0.01)),
                c = add(mesh, at + somewhere(random, 0.01));
    mesh.triangles.push_back({a, b, c});
  }
  return mesh;
}

/// Two boxes side by side with coincident faces in the middle.
TriMesh coincident() {
  TriMesh mesh;
  append(mesh, cutBox({0.05, 0.1, 0.05}, 4), {0.025, 0, 0});
  append(mesh, cutBox({0.05, 0.1, 0.05}, 4), {-0.025, 0, 0});
  return mesh;
}

}  // namespace

TriMesh strips(double gap, int count) {
  TriMesh mesh;
  constexpr double kWidth = 0.01, kLength = 0.1;
  for (int i = 0; i < count; ++i) {
    const double x = (i - 0.5 * count) * (kWidth + gap);
    const Index a = add(mesh, {x, -kLength / 2, 0}), b = add(mesh, {x + kWidth, -kLength / 2, 0}),
                c = add(mesh, {x + kWidth, kLength / 2, 0}), d = add(mesh, {x, kLength / 2, 0});
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  }
  buildAdjacency(mesh);
  return mesh;
}

std::vector<HardMesh> hardMeshes() {
  std::vector<HardMesh> meshes;
  const auto list = [&](const char* name, TriMesh mesh, bool is_wide = true) {
    buildAdjacency(mesh);
    meshes.push_back({name, std::make_shared<const TriMesh>(std::move(mesh)), is_wide});
  };
  list("needles", needles(), false);
  list("slivers", slivers(), false);
  list("without_area", withoutArea());
  list("duplicated", duplicated());
  list("inverted", inverted());
  list("t_junctions", tJunctions());
  list("cracks_of_1_um", strips(1e-6, 10));
  list("cracks_of_30_um", strips(30e-6, 10));
  list("cracks_of_1_mm", strips(1e-3, 9));
  list("open_shell", openShell());
  list("self_intersecting", selfIntersecting());
  list("noise", noise());
  list("soup", soup(), false);
  list("coincident", coincident());
  return meshes;
}

}  // namespace presa::test
