#pragma once
#include <cmath>
#include <fstream>
#include <functional>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "framework/scene/load.h"
#include "tests/apps/support/support.h"
#include "tests/modules/haptics_proxy/module_fixture.h"

namespace presa::test {

/// A block whose top is a height field over a grid: closed, welded, counter-clockwise. The lower side lies in z = 0.
struct Block {
  std::vector<double> xs, ys;  ///< [m]
  std::function<double(double, double)> z = [](double, double) { return 0.02; };
  std::function<std::string(double, double)> part = [](double, double) { return ""; };  ///< of the top's cells
  std::function<double(double, double)> grey = nullptr;                                 ///< of the top's vertices

  struct Vertex {
    double x, y, z, grey;
  };
  struct Triangle {
    std::size_t a, b, c;
    std::string part;
  };
  std::vector<Vertex> vertices;
  std::vector<Triangle> triangles;

  Block& build() {
    const std::size_t nx = xs.size(), ny = ys.size(), below = nx * ny;
    for (const bool top : {true, false})
      for (const double y : ys)
        for (const double x : xs) vertices.push_back({x, y, top ? z(x, y) : 0, grey ? grey(x, y) : 1});
    const auto quad = [&](std::size_t a, std::size_t b, std::size_t c, std::size_t d, const std::string& of) {
      triangles.push_back({a, b, c, of});
      triangles.push_back({a, c, d, of});
    };
    for (std::size_t j = 0; j + 1 < ny; ++j) {
      for (std::size_t i = 0; i + 1 < nx; ++i) {
        const std::size_t a = j * nx + i, b = a + 1, c = b + nx, d = a + nx;
        const std::string of = part((xs[i] + xs[i + 1]) / 2, (ys[j] + ys[j + 1]) / 2);
        quad(a, b, c, d, of);
        quad(below + a, below + d, below + c, below + b, of);
      }
    }
    for (std::size_t i = 0; i + 1 < nx; ++i) {
      const std::size_t back = (ny - 1) * nx + i;
      const double x = (xs[i] + xs[i + 1]) / 2;
      quad(below + i, below + i + 1, i + 1, i, part(x, ys.front()));
      quad(below + back + 1, below + back, back, back + 1, part(x, ys.back()));
    }
    for (std::size_t j = 0; j + 1 < ny; ++j) {
      const std::size_t left = j * nx, right = left + nx - 1;
      const double y = (ys[j] + ys[j + 1]) / 2;
      quad(below + left + nx, below + left, left, left + nx, part(xs.front(), y));
      quad(below + right, below + right + nx, right + nx, right, part(xs.back(), y));
    }
    return *this;
  }

  /// Writes it to the scratch folder: `name` with the ending obj or ply.
  std::string file(const std::string& name) const {
    std::ofstream out(scratch(name));
    out.precision(9);
    const bool obj = name.ends_with(".obj");
    if (!obj) {
      out << "ply\nformat ascii 1.0\nelement vertex " << vertices.size()
          << "\nproperty float x\nproperty float y\nproperty float z\n"
          << (grey ? "property uchar red\nproperty uchar green\nproperty uchar blue\n" : "") << "element face "
          << triangles.size() << "\nproperty list uchar int vertex_indices\nend_header\n";
    }
    for (const Vertex& v : vertices) {
      out << (obj ? "v " : "") << v.x << ' ' << v.y << ' ' << v.z;
      for (int c = 0; c < 3 && grey; ++c) {
        if (obj) out << ' ' << v.grey;
        if (!obj) out << ' ' << std::lround(255 * v.grey);
      }
      out << '\n';
    }
    std::string part_now;
    for (const Triangle& t : triangles) {
      if (obj && t.part != part_now) out << "usemtl " << t.part << '\n';
      part_now = t.part;
      if (obj) out << "f " << t.a + 1 << ' ' << t.b + 1 << ' ' << t.c + 1 << '\n';
      if (!obj) out << "3 " << t.a << ' ' << t.b << ' ' << t.c << '\n';
    }
    return name;
  }
};

/// 0, 1, 2 ... steps from `from` to `to`.
inline std::vector<double> grid(double from, double to, int steps) {
  std::vector<double> all;
  for (int i = 0; i <= steps; ++i) all.push_back(from + (to - from) * i / steps);
  return all;
}

/// A flat board of 120 mm by 60 mm by 20 mm in cells of 5 mm; its left half, x < 0, is of material "gel".
inline Block board() {
  Block block;
  block.xs = grid(-0.06, 0.06, 24);
  block.ys = grid(-0.03, 0.03, 12);
  block.part = [](double x, double) { return x < 0 ? "gel" : "wood"; };
  return block.build();
}

/// A body of 1000 N/m without damping, at odds with every axis, with the elements in its material.
inline Pose somewhere() { return {Vec3(0.1, -0.2, 0.3), Quat(Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()))}; }

inline World meshWorld(const std::string& mesh, const std::string& elements, const std::string& friction = "",
                       const std::string& scene_words = "", const std::string& shape = "") {
  const Pose X_WB = somewhere();
  std::ostringstream xml;
  xml.precision(17);
  xml << R"(<scene version="1.0" name="mesh"><world gravity="0 0 0"/>)" << scene_words
      << R"(<materials><material name="any" stiffness="1000">)" << friction << elements
      << "</material></materials>\n<body name=\"block\" fixed=\"true\" pos=\"" << X_WB.p.transpose() << "\" quat=\""
      << X_WB.q.w() << ' ' << X_WB.q.vec().transpose() << "\"><haptic>"
      << (shape.empty() ? "<mesh file=\"" + mesh + "\"/>" : shape) << "</haptic></body>\n"
      << R"(<devices><device role="finger" fingertip_radius="0.008"/></devices></scene>)";
  const std::string file = scratch("mesh_world.xml");
  std::ofstream(file) << xml.str();
  Diagnostics diagnostics;
  Scene scene = loadScene(file, {}, diagnostics);
  if (diagnostics.hasErrors()) throw InputError(std::move(diagnostics));
  World world = buildWorld(std::move(scene), Rig{}, diagnostics);
  if (diagnostics.hasErrors()) throw InputError(std::move(diagnostics));
  return world;
}

/// One finger that meets a block, in coordinates of the body.
class OnBlock {
 public:
  explicit OnBlock(const World& world) : finger_(world), X_WB_(world.scene.bodies[0].X_WB) {}
  /// With the finger's centre at p_B [N].
  Vec3 force(const Vec3& p_B) {
    if (!started_) finger_.tick(X_WB_ * Vec3(p_B.x(), p_B.y(), 0.08));
    started_ = true;
    return X_WB_.q.conjugate() * tick(p_B).f_H_W;
  }
  const FingerContact& tick(const Vec3& p_B) { return finger_.tick(X_WB_ * p_B); }

 private:
  OneFinger finger_;
  Pose X_WB_;
  bool started_ = false;
};

/// Work on a finger that goes once around a closed path, by the trapezium rule [J].
struct Round {
  double net = 0, moved = 0;  ///< sum, and sum of the amounts
};
inline Round roundOf(OnBlock& finger, int steps, const std::function<Vec3(double)>& path) {
  Round sum;
  Vec3 last_p = path(0), last_f = finger.force(last_p);
  for (int i = 1; i <= steps; ++i) {
    const Vec3 p = path(2 * std::numbers::pi * (i % steps) / steps), f = finger.force(p);
    const double work = 0.5 * (f + last_f).dot(p - last_p);
    sum.net += work;
    sum.moved += std::abs(work);
    last_p = p;
    last_f = f;
  }
  return sum;
}

}  // namespace presa::test
