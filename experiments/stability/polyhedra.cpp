#include "experiments/stability/polyhedra.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>

namespace presa::stability {
namespace {

constexpr double kRadian = std::numbers::pi / 180;

bool inAll(const std::vector<Plane>& half_spaces, const Vec3& p) {
  constexpr double kRounding = 1e-12;  // [m]
  return std::all_of(half_spaces.begin(), half_spaces.end(),
                     [&](const Plane& plane) { return plane.nhat.dot(p) >= plane.offset - kRounding; });
}

/// Projection of p onto the intersection of the given planes; not finite when they have no common point.
Vec3 ontoAll(const std::vector<const Plane*>& planes, const Vec3& p) {
  const auto n = static_cast<Eigen::Index>(planes.size());
  Eigen::MatrixXd normals(n, 3);
  Eigen::VectorXd lack(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    normals.row(i) = planes[static_cast<std::size_t>(i)]->nhat.transpose();
    lack[i] = planes[static_cast<std::size_t>(i)]->offset - normals.row(i).dot(p);
  }
  const Eigen::FullPivLU<Eigen::MatrixXd> gram(normals * normals.transpose());
  if (!gram.isInvertible()) return Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  return p + normals.transpose() * gram.solve(lack);
}

void addQuad(Solid& solid, int a, int b, int c, int d) {
  solid.triangles.push_back({a, b, c});
  solid.triangles.push_back({a, c, d});
}

/// Plane of a triangle with its normal towards `inside`.
Plane planeThrough(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& inside) {
  Vec3 nhat = (b - a).cross(c - a).normalized();
  if (nhat.dot(inside - a) < 0) nhat = -nhat;
  return {nhat, nhat.dot(a)};
}

/// Corner i of a regular polygon with `count` sides about the z axis and the given inradius, at height z.
Vec3 onRing(int i, int count, double inradius, double z) {
  const double angle = 2 * std::numbers::pi * i / count, reach = inradius / std::cos(std::numbers::pi / count);
  return {reach * std::cos(angle), reach * std::sin(angle), z};
}

}  // namespace

Vec3 nearestInAll(const std::vector<Plane>& half_spaces, const Vec3& p) {
  if (inAll(half_spaces, p)) return p;
  Vec3 best = p;
  double min = std::numeric_limits<double>::infinity();
  const auto consider = [&](const std::vector<const Plane*>& planes) {
    const Vec3 candidate = ontoAll(planes, p);
    const double distance = (candidate - p).norm();
    if (candidate.allFinite() && distance < min && inAll(half_spaces, candidate)) best = candidate, min = distance;
  };
  for (std::size_t i = 0; i < half_spaces.size(); ++i) {
    consider({&half_spaces[i]});
    for (std::size_t j = 0; j < i; ++j) {
      consider({&half_spaces[i], &half_spaces[j]});
      for (std::size_t k = 0; k < j; ++k) consider({&half_spaces[i], &half_spaces[j], &half_spaces[k]});
    }
  }
  if (!std::isfinite(min)) throw std::logic_error("the half-spaces have no common point");
  return best;
}

Solid grooved(double angle_deg, double depth) {
  const double half = angle_deg / 2 * kRadian, mouth = depth * std::tan(half);
  const double out = mouth + 0.02, below = depth + 0.02, length = 0.05;
  Solid solid;
  solid.hollow = true;
  solid.feature = {0, 0, -depth};
  solid.planes = {{{-std::cos(half), 0, std::sin(half)}, -depth * std::sin(half)},
                  {{std::cos(half), 0, std::sin(half)}, -depth * std::sin(half)}};
  const std::vector<std::pair<double, double>> section{{0, -depth},   {-mouth, 0}, {-out, 0}, {-out, -below},
                                                       {out, -below}, {out, 0},    {mouth, 0}};
  const int n = static_cast<int>(section.size());
  for (const double y : {-length, length}) {
    for (const auto& [x, z] : section) solid.vertices.emplace_back(x, y, z);
  }
  for (int i = 0; i < n; ++i) addQuad(solid, i, n + i, n + (i + 1) % n, (i + 1) % n);
  for (int i = 1; i + 1 < n; ++i) {  // end faces, as seen from the bottom of the groove
    solid.triangles.push_back({0, i, i + 1});
    solid.triangles.push_back({n, n + i + 1, n + i});
  }
  return solid;
}

Solid pitted(int walls, double inradius, double depth) {
  Solid solid;
  solid.hollow = true;
  solid.feature = {0, 0, -depth};
  const double rings[3][2] = {{inradius, 0}, {inradius + 0.02, 0}, {inradius + 0.02, -depth - 0.02}};
  for (const auto& [reach, z] : rings) {
    for (int i = 0; i < walls; ++i) solid.vertices.push_back(onRing(i, walls, reach, z));
  }
  const int bottom = 3 * walls, under = bottom + 1;
  solid.vertices.push_back(solid.feature);
  solid.vertices.emplace_back(0, 0, -depth - 0.02);
  for (int i = 0; i < walls; ++i) {
    const int next = (i + 1) % walls;
    solid.triangles.push_back({bottom, i, next});
    addQuad(solid, i, walls + i, walls + next, next);
    addQuad(solid, walls + i, 2 * walls + i, 2 * walls + next, walls + next);
    solid.triangles.push_back({under, 2 * walls + next, 2 * walls + i});
    solid.planes.push_back(planeThrough(solid.feature, solid.vertices[static_cast<std::size_t>(i)],
                                        solid.vertices[static_cast<std::size_t>(next)], Vec3::Zero()));
  }
  return solid;
}

Solid needle(double length, double radius) {
  constexpr int kSides = 8;
  Solid solid;
  for (int i = 0; i < kSides; ++i) solid.vertices.push_back(onRing(i, kSides, radius, -length));
  solid.vertices.emplace_back(0, 0, 0);
  solid.vertices.emplace_back(0, 0, -length);
  const Vec3 middle(0, 0, -length / 2);
  solid.planes.push_back({Vec3::UnitZ(), -length});
  for (int i = 0; i < kSides; ++i) {
    const int next = (i + 1) % kSides;
    solid.triangles.push_back({kSides, i, next});
    solid.triangles.push_back({kSides + 1, next, i});
    solid.planes.push_back(planeThrough(solid.feature, solid.vertices[static_cast<std::size_t>(i)],
                                        solid.vertices[static_cast<std::size_t>(next)], middle));
  }
  return solid;
}

Solid striped(const std::vector<double>& widths, double edge) {
  Solid solid;
  solid.feature = {edge / 2, edge / 2, 0};
  solid.outward = Vec3::Ones().normalized();
  for (int axis = 0; axis < 3; ++axis) {
    solid.planes.push_back({Vec3::Unit(axis), axis == 2 ? -edge : -edge / 2});
    solid.planes.push_back({-Vec3::Unit(axis), axis == 2 ? 0 : -edge / 2});
  }
  std::vector<double> at{-edge / 2};
  for (std::size_t i = 0; at.back() + widths[i % widths.size()] < edge / 2; ++i) {
    at.push_back(at.back() + widths[i % widths.size()]);
  }
  at.push_back(edge / 2);
  for (const double x : at) {
    for (const auto& [y, z] : {std::pair{-0.5, 0.0}, {0.5, 0.0}, {0.5, -1.0}, {-0.5, -1.0}}) {
      solid.vertices.emplace_back(x, y * edge, z * edge);
    }
  }
  const int last = static_cast<int>(4 * (at.size() - 1));
  for (int i = 0; i < last; i += 4) {
    for (int k = 0; k < 4; ++k) addQuad(solid, i + k, i + 4 + k, i + 4 + (k + 1) % 4, i + (k + 1) % 4);
  }
  addQuad(solid, 0, 1, 2, 3);
  addQuad(solid, last, last + 3, last + 2, last + 1);
  return solid;
}

void writeObj(const Solid& solid, const std::string& file) {
  std::ofstream out(file);
  out.precision(17);
  for (const Vec3& v : solid.vertices) out << "v " << v.x() << " " << v.y() << " " << v.z() << "\n";
  for (const auto& t : solid.triangles) out << "f " << t[0] + 1 << " " << t[1] + 1 << " " << t[2] + 1 << "\n";
  if (!out.flush()) throw std::runtime_error("cannot write " + file);
}

}  // namespace presa::stability
