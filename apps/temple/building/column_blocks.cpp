#include "apps/temple/building/column_blocks.h"

#include <algorithm>
#include <cmath>

#include "apps/temple/building/ring_stack.h"

namespace presa::temple {
namespace {

// number of points of a flute, and of rings of a drum or an echinus
struct Fineness {
  std::size_t flute, rings;
};
constexpr Fineness kVisual{8, 8}, kHaptic{4, 3};

double marginOf(const Proportions& p) { return 1.5 * p.stone.chip_depth; }

/// Appends the rings of a bearing face with a square dowel hole in its middle: from the floor of the hole out to the
/// inset edge for the lower face (`below`), in the opposite order for the upper face.
void appendFace(std::vector<Ring>& rings, const Proportions& p, const Ring& inset, double z, bool below) {
  const double half = 0.5 * p.column.dowel_width * p.module, depth = p.column.dowel_depth * p.module;
  const Ring rim = square(half, z, inset.size()), floor = square(half, below ? z + depth : z - depth, inset.size());
  if (below)
    rings.insert(rings.end(), {floor, rim, inset});
  else
    rings.insert(rings.end(), {inset, rim, floor});
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

TriMesh drumMesh(const Proportions& p, int i, const Breaks& breaks, const Fineness& fineness) {
  const std::size_t count = fineness.flute * static_cast<std::size_t>(p.column.flutes);
  const double h = drumHeight(p), foot = i * h, margin = marginOf(p);
  const auto ring = [&](double z) { return fluted(shaftRadius(p, foot + z), z - h / 2, count, p.column.flutes); };
  const auto inset = [&](double z) {
    return scaled(ring(z), Vec3(0, 0, z - h / 2), 1 - margin / shaftRadius(p, foot + z));
  };
  std::vector<Ring> rings;
  appendFace(rings, p, inset(0), -h / 2, true);
  rings.push_back(ring(0));
  breaks.apply(rings.back(), false);
  for (std::size_t r = 0; r <= fineness.rings; ++r)
    rings.push_back(ring(margin + (h - 2 * margin) * static_cast<double>(r) / static_cast<double>(fineness.rings)));
  rings.push_back(ring(h));
  breaks.apply(rings.back(), true);
  appendFace(rings, p, inset(h), h / 2, false);
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
  appendFace(rings, p, scaled(foot, {0, 0, bottom}, 1 - margin / neck), bottom, true);
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
  appendFace(rings, p, square(abacus - margin, top, count), top, false);
  const double floor = h / 2 - p.column.dowel_depth * p.module;
  return stackRings(rings, {0, 0, -floor}, {0, 0, floor});
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
  return block;
}

Block makeCapital(const Proportions& p, RandomStream chips) {
  Block block;
  block.kind = BlockKind::kCapital;
  const Breaks breaks(p, chips);
  block.visual = capitalMesh(p, breaks, kVisual);
  block.haptic = capitalMesh(p, breaks, kHaptic);
  const double width = p.column.abacus_width * p.module;
  block.physics = Box{{width, width, p.column.capital_height * p.module}};
  return block;
}

}  // namespace presa::temple
