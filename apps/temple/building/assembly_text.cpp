#include "apps/temple/building/assembly_text.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "apps/temple/building/words.h"

namespace presa::temple {
namespace {

constexpr double kTouch = 1e-3;  // max gap between blocks that touch [m]
constexpr double kSame = 1e-6;   // [m]

struct Bounds {
  Vec3 low, high;
};

/// Axis-aligned bounds in W of the block's physics shape at its goal pose [m].
Bounds boundsOf(const Block& block) {
  struct Corners {
    const TriMesh& mesh;
    std::vector<Vec3> operator()(const MeshRef&) const { return mesh.vertices; }
    std::vector<Vec3> operator()(const Box& box) const { return of(box.size / 2); }
    std::vector<Vec3> operator()(const Cylinder& rod) const { return of({rod.radius, rod.radius, rod.length / 2}); }
    std::vector<Vec3> operator()(const Compound&) const { return {}; }
    std::vector<Vec3> operator()(const Sphere& s) const { return of(Vec3::Constant(s.radius)); }
    std::vector<Vec3> operator()(const Capsule& rod) const {
      return of({rod.radius, rod.radius, rod.length / 2 + rod.radius});
    }
    static std::vector<Vec3> of(const Vec3& half) {
      std::vector<Vec3> corners;
      for (int i = 0; i < 8; ++i)
        corners.emplace_back(i & 1 ? half.x() : -half.x(), i & 2 ? half.y() : -half.y(), i & 4 ? half.z() : -half.z());
      return corners;
    }
  };
  Bounds bounds{Vec3::Constant(1e9), Vec3::Constant(-1e9)};
  for (const Vec3& corner : std::visit(Corners{block.physics_mesh}, block.physics)) {
    bounds.low = bounds.low.cwiseMin(block.X_WB * corner);
    bounds.high = bounds.high.cwiseMax(block.X_WB * corner);
  }
  return bounds;
}

bool alike(const Block& a, const Block& b) {
  if (a.kind != b.kind || a.physics.index() != b.physics.index()) return false;
  // bounds in the own frame identify boxes and cylinders; wedges with equal bounds may be mirror images
  Block at_rest_a = a, at_rest_b = b;
  at_rest_a.X_WB = at_rest_b.X_WB = {};
  const Bounds one = boundsOf(at_rest_a), other = boundsOf(at_rest_b);
  return (one.low - other.low).norm() < kSame && (one.high - other.high).norm() < kSame &&
         !std::holds_alternative<MeshRef>(a.physics);
}

template <class Number>
std::string numbers(std::initializer_list<Number> values) {
  std::string text;
  for (const Number value : values) {
    std::array<char, 40> one;
    std::snprintf(one.data(), one.size(), "%s%.17g", text.empty() ? "" : " ", value);
    text += one.data();
  }
  return text;
}

std::string namesOf(const Building& building, const std::vector<std::size_t>& blocks) {
  std::string text;
  for (const std::size_t i : blocks) text += (text.empty() ? "" : " ") + building.blocks[i].name;
  return text;
}

}  // namespace

std::vector<std::size_t> fitting(const Building& building, std::size_t i) {
  std::vector<std::size_t> blocks;
  for (std::size_t j = 0; j < building.blocks.size(); ++j) {
    if (j == i || alike(building.blocks[i], building.blocks[j])) blocks.push_back(j);
  }
  return blocks;
}

std::vector<std::size_t> supporting(const Building& building, std::size_t i) {
  std::vector<std::size_t> below;
  const Bounds mine = boundsOf(building.blocks[i]);
  // compare along the normal of the bearing face: on a slope the origin of a supporting block may be higher in z
  const Vec3 up = building.blocks[i].X_WB.q * Vec3::UnitZ();
  for (std::size_t j = 0; j < building.blocks.size(); ++j) {
    if (j == i) continue;
    const Bounds other = boundsOf(building.blocks[j]);
    const bool overlap = (mine.low.array() < other.high.array() + kTouch).all() &&
                         (other.low.array() < mine.high.array() + kTouch).all();
    const bool beside = mine.low.x() > other.high.x() - kTouch || mine.high.x() < other.low.x() + kTouch;
    if (overlap && !beside && up.dot(building.blocks[i].X_WB.p - building.blocks[j].X_WB.p) > kTouch)
      below.push_back(j);
  }
  return below;
}

std::string assemblyText(const Building& building, const Vec3& workspace, const AssemblyWords& words, double elapsed) {
  std::string text = elapsed > 0 ? "  <assembly spent=\"" + numbers({elapsed}) + "\">\n" : "  <assembly>\n";
  if (!words.elements.empty()) text += wordsText(words);
  text += "    <field pos=\"" + numbers({0.0, 0.0, workspace.z() / 2}) + "\" size=\"" +
          numbers({workspace.x(), workspace.y(), workspace.z()}) + "\"/>\n";
  for (std::size_t i = 0; i < building.blocks.size(); ++i) {
    const Block& block = building.blocks[i];
    const Pose& X = block.X_WB;
    text += "    <goal name=\"" + block.name + "\" bodies=\"" + namesOf(building, fitting(building, i)) + "\" pos=\"" +
            numbers({X.p.x(), X.p.y(), X.p.z()}) + "\" quat=\"" + numbers({X.q.w(), X.q.x(), X.q.y(), X.q.z()}) + "\"";
    if (!words.elements.empty()) text += std::string(" element=\"") + elementName(block.kind) + "\"";
    // the stone below guides a tenon; only once half of it is in, the goal holds it
    if (block.tenon > 0) text += " reach=\"" + numbers({block.tenon / 2}) + "\"";
    if (block.fold != 1) text += " fold=\"" + std::to_string(block.fold) + "\"";
    if (const auto below = supporting(building, i); !below.empty())
      text += " after=\"" + namesOf(building, below) + "\"";
    text += "/>\n";
  }
  return text + "  </assembly>\n";
}

}  // namespace presa::temple
