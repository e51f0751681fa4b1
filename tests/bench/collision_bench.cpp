// Cost of gathering the triangles around a fingertip: our traversal of FCL's boxes against fcl::collide with a sphere.
#include <benchmark/benchmark.h>
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>

#include <cmath>
#include <random>

#include "modules/collision_fcl/triangle_index.h"

namespace {

using presa::TriMesh;
using presa::Vec3;

/// A bumpy sphere 10 cm across: 5 subdivisions are 20 480 triangles, 7 are 327 680.
std::shared_ptr<const TriMesh> bumpySphere(int subdivisions) {
  TriMesh mesh = presa::makeSphere(0.05, subdivisions);
  for (Vec3& v : mesh.vertices) v *= 1 + 0.01 * std::sin(300 * v.x()) * std::sin(300 * v.y()) * std::sin(300 * v.z());
  return std::make_shared<const TriMesh>(std::move(mesh));
}

/// Points within 1 mm of the surface.
std::vector<Vec3> queries(const TriMesh& mesh) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1e-3, 1e-3);
  std::vector<Vec3> points;
  for (int i = 0; i < 256; ++i) {
    const Vec3& vertex = mesh.vertices[random() % mesh.vertices.size()];
    points.push_back(vertex * (1 + uniform(random) / 0.05));
  }
  return points;
}

void GatherOwnTraversal(benchmark::State& state) {
  const auto mesh = bumpySphere(static_cast<int>(state.range(0)));
  const double radius = 1e-3 * static_cast<double>(state.range(1));
  const presa::TriangleIndex index(mesh);
  const std::vector<Vec3> points = queries(*mesh);
  std::vector<presa::NearTriangle> near;
  std::size_t i = 0, found = 0;
  for (auto _ : state) {
    index.gather(points[i++ % points.size()], radius, mesh->triangles.size(), near);
    found += near.size();
  }
  state.counters["triangles"] = static_cast<double>(found) / static_cast<double>(i);
}

void GatherFclCollide(benchmark::State& state) {
  const auto mesh = bumpySphere(static_cast<int>(state.range(0)));
  fcl::BVHModel<fcl::OBB<double>> model;  // with AABB fcl::collide copies the whole mesh at every call
  std::vector<fcl::Triangle> triangles;
  for (const auto& t : mesh->triangles) {
    triangles.emplace_back(static_cast<std::size_t>(t[0]), static_cast<std::size_t>(t[1]),
                           static_cast<std::size_t>(t[2]));
  }
  model.beginModel();
  model.addSubModel(mesh->vertices, triangles);
  model.endModel();
  const fcl::Sphere<double> sphere(1e-3 * static_cast<double>(state.range(1)));
  const std::vector<Vec3> points = queries(*mesh);
  const fcl::CollisionRequest<double> request(mesh->triangles.size(), false);
  std::size_t i = 0, found = 0;
  for (auto _ : state) {
    fcl::CollisionResult<double> result;
    fcl::Transform3<double> placed = fcl::Transform3<double>::Identity();
    placed.translation() = points[i++ % points.size()];
    fcl::collide<double>(&model, fcl::Transform3<double>::Identity(), &sphere, placed, request, result);
    found += result.numContacts();
  }
  state.counters["triangles"] = static_cast<double>(found) / static_cast<double>(i);
}

void arguments(benchmark::internal::Benchmark* bench) {
  bench->ArgNames({"subdivisions", "radius_mm"})->ArgsProduct({{5, 7}, {2, 5}})->Unit(benchmark::kMicrosecond);
}
BENCHMARK(GatherOwnTraversal)->Apply(arguments);
BENCHMARK(GatherFclCollide)->Apply(arguments);

}  // namespace
