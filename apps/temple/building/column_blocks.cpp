#include "apps/temple/building/column_blocks.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/temple/building/ring_stack.h"

namespace presa::temple {
namespace {

// number of points of a flute, and of rings of a drum or an echinus
struct Fineness {
  std::size_t flute, rings;
};
constexpr Fineness kVisual{8, 8}, kHaptic{4, 3};

double marginOf(const Proportions& p) { return 1.5 * p.stone.chip_depth; }

/// Half width at a height [m].
struct Step {
  double half, z;
};
/// A hole, or a tenon, of square section: from its end to the bearing face. All chamfers are half as high again as wide, so
/// that stone slides down them.
std::vector<Step> holeSteps(const Proportions& p, double z, bool below) {
  const double half = 0.5 * p.column.dowel_width * p.module, depth = p.column.dowel_depth * p.module;
  return {{half, below ? z + depth : z - depth}, {half, z}};
}
constexpr double kChamferRise = 1.5;
std::vector<Step> tenonSteps(const Proportions& p, double z) {
  const double chamfer = p.column.tenon_chamfer * p.module, height = p.column.tenon_height * p.module;
  const double half = 0.5 * (p.column.dowel_width - p.column.tenon_play) * p.module;
  return {{half - chamfer, z - height}, {half, z - height + kChamferRise * chamfer}, {half, z}};
}
std::vector<Step> mortiseSteps(const Proportions& p, double z) {
  const double chamfer = p.column.tenon_chamfer * p.module;
  std::vector<Step> steps = holeSteps(p, z, false);
  steps.back() = {steps.front().half, z - kChamferRise * chamfer};
  steps.push_back({steps.front().half + chamfer, z});
  return steps;
}

/// Appends the rings of a bearing face with these steps in its middle: from their end out to the inset edge for the lower
/// face (`below`), in the opposite order for the upper face.
void appendFace(std::vector<Ring>& rings, const std::vector<Step>& steps, const Ring& inset, bool below) {
  std::vector<Ring> face;
  for (const Step& step : steps) face.push_back(square(step.half, step.z, inset.size()));
  face.push_back(inset);
  if (!below) std::ranges::reverse(face);
  rings.insert(rings.end(), face.begin(), face.end());
}

/// Chips in the edges of the lower and the upper face. Positions are drawn as fractions of a turn, so that the meshes
/// of every fineness get the same chips.
class Breaks {
 public:
  Breaks(const Proportions& p, RandomStream random) : depth_(p.stone.chip_depth) {
    for (int i = 0; i < p.stone.chips; ++i) {
      Break one;
      one.turn = random.uniform();
      one.upper = random.uniform() < 0.5;
      one.depth = depth_ * random.uniform(0.6, 1.0);
      one.width = depth_ * random.uniform(3, 7);
      breaks_.push_back(one);
    }
  }
  void apply(Ring& rim, bool upper) const {
    for (const Break& one : breaks_) {
      if (one.upper != upper) continue;
      const auto at = static_cast<std::size_t>(one.turn * static_cast<double>(rim.size()));
      Vec3 inward = -rim[at];
      inward.z() = 0;
      inward = (inward.normalized() + Vec3(0, 0, upper ? -1 : 1)).normalized();
      chip(rim, {at, one.width, one.depth}, inward);
    }
  }

 private:
  struct Break {
    double turn, depth, width;
    bool upper;
  };
  double depth_;
  std::vector<Break> breaks_;
};

bool hasMortise(const Proportions& p, int drum) { return p.column.tenon && drum + 1 == p.column.drums; }

TriMesh drumMesh(const Proportions& p, int i, const Breaks& breaks, const Fineness& fineness) {
  const std::size_t count = fineness.flute * static_cast<std::size_t>(p.column.flutes);
  const double h = drumHeight(p), foot = i * h, margin = marginOf(p);
  const auto ring = [&](double z) { return fluted(shaftRadius(p, foot + z), z - h / 2, count, p.column.flutes); };
  const auto inset = [&](double z) {
    return scaled(ring(z), Vec3(0, 0, z - h / 2), 1 - margin / shaftRadius(p, foot + z));
  };
  std::vector<Ring> rings;
  appendFace(rings, holeSteps(p, -h / 2, true), inset(0), true);
  rings.push_back(ring(0));
  breaks.apply(rings.back(), false);
  for (std::size_t r = 0; r <= fineness.rings; ++r)
    rings.push_back(ring(margin + (h - 2 * margin) * static_cast<double>(r) / static_cast<double>(fineness.rings)));
  rings.push_back(ring(h));
  breaks.apply(rings.back(), true);
  appendFace(rings, hasMortise(p, i) ? mortiseSteps(p, h / 2) : holeSteps(p, h / 2, false), inset(h), false);
  const double floor = h / 2 - p.column.dowel_depth * p.module;
  return stackRings(rings, {0, 0, -floor}, {0, 0, floor});
}

/// Capital, from below: necking with the ends of the flutes, echinus, abacus, a third of the height each
/// [Vitruvius IV.3.4].
TriMesh capitalMesh(const Proportions& p, const Breaks& breaks, const Fineness& fineness) {
  const std::size_t count = fineness.flute * static_cast<std::size_t>(p.column.flutes);
  const double h = p.column.capital_height * p.module, margin = marginOf(p);
  const double neck = 0.5 * p.column.upper_diameter * p.module, abacus = 0.5 * p.column.abacus_width * p.module;
  const double third = h / 3, bottom = -h / 2, top = h / 2;
  std::vector<Ring> rings;
  const Ring foot = fluted(neck, bottom, count, p.column.flutes);
  const std::vector<Step> middle = p.column.tenon ? tenonSteps(p, bottom) : holeSteps(p, bottom, true);
  appendFace(rings, middle, scaled(foot, {0, 0, bottom}, 1 - margin / neck), true);
  rings.push_back(foot);
  rings.push_back(moved(foot, {0, 0, 0.8 * third}));
  rings.push_back(circle(neck, bottom + third, count));
  // echinus: a steep curve that bends inwards under the abacus
  const double reach = std::max(neck, abacus - margin);
  for (std::size_t r = 1; r <= fineness.rings; ++r) {
    const double t = static_cast<double>(r) / static_cast<double>(fineness.rings);
    rings.push_back(
        circle(neck + (reach - neck) * std::sin(1.25 * t) / std::sin(1.25), bottom + third * (1 + t), count));
  }
  rings.push_back(square(abacus, bottom + 2 * third, count));
  breaks.apply(rings.back(), false);
  rings.push_back(square(abacus, bottom + 2 * third + margin, count));
  rings.push_back(square(abacus, top - margin, count));
  rings.push_back(square(abacus, top, count));
  breaks.apply(rings.back(), true);
  appendFace(rings, holeSteps(p, top, false), square(abacus - margin, top, count), false);
  return stackRings(rings, {0, 0, middle.front().z}, {0, 0, top - p.column.dowel_depth * p.module});
}

/// A quarter of the stone around a mortise, towards +x: convex, between the diagonals, from the flat side of the hole to a
/// line around an arc of `radius`.
TriMesh quarterAround(const std::vector<Step>& mortise, double radius) {
  constexpr int kArc = 12;
  radius /= std::cos(std::numbers::pi / (4 * kArc));
  std::vector<Ring> rings;
  Vec3 center = Vec3::Zero();
  for (const Step& step : mortise) {
    Ring ring{{step.half, -step.half, step.z}};
    for (int k = 0; k <= kArc; ++k) {
      const double angle = std::numbers::pi / 2 * (static_cast<double>(k) / kArc - 0.5);
      ring.emplace_back(radius * std::cos(angle), radius * std::sin(angle), step.z);
    }
    ring.emplace_back(step.half, step.half, step.z);
    rings.push_back(std::move(ring));
  }
  center.x() = (mortise.front().half + radius) / 2;
  return stackRings(rings, center + mortise.front().z * Vec3::UnitZ(), center + mortise.back().z * Vec3::UnitZ());
}

/// A drum of the radius of its physics shape with a mortise in its upper face.
std::vector<Block::Part> partsAround(const Proportions& p, double radius) {
  const double h = drumHeight(p), depth = p.column.dowel_depth * p.module;
  std::vector<Block::Part> parts{{Cylinder{radius, h - depth}, {0, 0, -depth / 2}}};
  for (int turn = 0; turn < 4; ++turn) {
    TriMesh quarter = quarterAround(mortiseSteps(p, h / 2), radius);
    const Quat turned(Eigen::AngleAxisd(turn * std::numbers::pi / 2, Vec3::UnitZ()));
    for (Vec3& vertex : quarter.vertices) vertex = turned * vertex;
    parts.push_back({MeshRef{}, Vec3::Zero(), std::move(quarter)});
  }
  return parts;
}

/// A capital of this box with a tenon below.
std::vector<Block::Part> partsWithTenon(const Proportions& p, const Box& capital) {
  const std::vector<Step> steps = tenonSteps(p, -capital.size.z() / 2);
  constexpr std::size_t kCorners = 8;
  std::vector<Ring> rings;
  for (const Step& step : steps) rings.push_back(square(step.half, step.z, kCorners));
  TriMesh tenon = stackRings(rings, {0, 0, steps.front().z}, {0, 0, steps.back().z});
  return {{capital, Vec3::Zero()}, {MeshRef{}, Vec3::Zero(), std::move(tenon)}};
}

}  // namespace

double drumHeight(const Proportions& p) {
  return (p.column.height - p.column.capital_height) * p.module / p.column.drums;
}

double shaftRadius(const Proportions& p, double height) {
  const double t = height / (drumHeight(p) * p.column.drums);
  return p.module * (1 + (0.5 * p.column.upper_diameter - 1) * t + 4 * p.column.entasis * t * (1 - t));
}

Block makeDrum(const Proportions& p, int i, RandomStream chips) {
  Block block;
  block.kind = BlockKind::kDrum;
  const Breaks breaks(p, chips);
  block.visual = drumMesh(p, i, breaks, kVisual);
  block.haptic = drumMesh(p, i, breaks, kHaptic);
  double radius = 0;
  for (const TriMesh* mesh : {&block.visual, &block.haptic}) {
    for (const Vec3& vertex : mesh->vertices) radius = std::max(radius, vertex.head<2>().norm());
  }
  block.physics = Cylinder{radius, drumHeight(p)};
  if (hasMortise(p, i)) block.parts = partsAround(p, radius);
  return block;
}

Block makeCapital(const Proportions& p, RandomStream chips) {
  Block block;
  block.kind = BlockKind::kCapital;
  const Breaks breaks(p, chips);
  block.visual = capitalMesh(p, breaks, kVisual);
  block.haptic = capitalMesh(p, breaks, kHaptic);
  const double width = p.column.abacus_width * p.module;
  const Box box{{width, width, p.column.capital_height * p.module}};
  block.physics = box;
  if (p.column.tenon) {
    block.parts = partsWithTenon(p, box);
    block.tenon = p.column.tenon_height * p.module;
  }
  return block;
}

}  // namespace presa::temple
