#include "apps/temple/building/building.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "apps/temple/building/column_blocks.h"
#include "apps/temple/building/entablature_blocks.h"
#include "apps/temple/building/figure.h"

namespace presa::temple {
namespace {

constexpr double kPerson = 1.7;         // height [m]
constexpr double kBehindStones = 0.22;  // of the person; stones fall before it [m]

/// Sets block on block, from the ground up. `level_` is the height reached so far.
class Builder {
 public:
  Builder(const Proportions& proportions, double behind, std::uint64_t seed)
      : p_(proportions), behind_(behind), seed_(seed) {
    building_.name = p_.name;
    building_.upright = p_.upright;
    if (p_.entablature) intervals_ = p_.entablature->intervals;
    span_ = std::accumulate(intervals_.begin(), intervals_.end(), 0.0) * p_.module;
  }

  Building build() {
    laySteps();
    double x = -span_ / 2;
    const double foot = level_;
    for (std::size_t i = 0; i <= intervals_.size(); ++i) {
      level_ = foot;
      setColumn(x, intervals_.empty() ? "" : "column" + std::to_string(i + 1) + "_");
      if (i < intervals_.size()) x += intervals_[i] * p_.module;
    }
    if (p_.entablature) setEntablature();
    if (p_.pediment) setPediment();
    if (p_.full_size > 0) standFigure();
    return std::move(building_);
  }

 private:
  RandomStream chipsOf(const std::string& name) const { return {seed_, "chips of " + name}; }
  double m(double modules) const { return modules * p_.module; }

  void place(Block block, const std::string& name, const Vec3& p_WB, const Quat& q_WB = Quat::Identity()) {
    block.name = name;
    block.X_WB = {p_WB + Vec3(0, behind_, 0), q_WB};
    if (block.kind == BlockKind::kDrum) block.fold = block.parts.empty() ? p_.column.flutes : 4;  // of its mortise
    if (block.kind == BlockKind::kCapital) block.fold = 4;
    if (block.kind == BlockKind::kArchitrave) block.fold = 2;
    const double volume = massProperties(block.haptic).volume;
    block.mass = std::clamp(p_.stone.density * volume, p_.stone.lightest, p_.stone.heaviest);
    for (const Vec3& vertex : block.visual.vertices) building_.top = std::max(building_.top, (block.X_WB * vertex).z());
    building_.blocks.push_back(std::move(block));
  }

  void laySteps() {
    const double height = m(p_.steps.height);
    for (int i = 0; i < p_.steps.count; ++i) {
      const double treads = m((p_.steps.count - 1 - i) * p_.steps.tread);
      // a lone column stands on a piece of its building's steps, which is cut off on the other sides
      const double beyond = m(p_.steps.beyond) + (p_.entablature ? treads : 0);
      const double before = m(Proportions::Steps::kBeforeAxis) + treads;
      building_.footings.push_back({"step" + std::to_string(i + 1),
                                    {{0, behind_ + (beyond - before) / 2, level_ + height / 2}, Quat::Identity()},
                                    {span_ + 2 * beyond, before + beyond, height}});
      level_ += height;
    }
  }

  void setColumn(double x, const std::string& prefix) {
    const double height = drumHeight(p_);
    for (int i = 0; i < p_.column.drums; ++i) {
      const std::string name = prefix + "drum" + std::to_string(i + 1);
      place(makeDrum(p_, i, chipsOf(name)), name, {x, 0, level_ + height / 2});
      level_ += height;
    }
    const double capital = m(p_.column.capital_height);
    place(makeCapital(p_, chipsOf(prefix + "capital")), prefix + "capital", {x, 0, level_ + capital / 2});
    level_ += capital;
  }

  /// A person beside the building, at its scale: on the ground to the left, behind it and where stones fall.
  void standFigure() {
    const Footing& widest = building_.footings.front();
    const double height = kPerson * p_.module / p_.full_size;
    const Vec3 p_WB(widest.X_WB.p.x() - widest.size.x() / 2 - 0.9 * height,
                    std::max(widest.X_WB.p.y() + widest.size.y() / 2, kBehindStones), 0);
    building_.figure = Figure{makeFigure(height), {p_WB, Quat(Eigen::AngleAxisd(0.5, Vec3::UnitZ()))}, height};
  }

  void setEntablature() {
    const Proportions::Entablature& e = *p_.entablature;
    // joints are above the columns' axes; the ends are flush with the columns' feet
    const double joint = p_.stone.joint / 2;
    double left = -span_ / 2 - m(1);
    double axis = -span_ / 2;
    for (std::size_t i = 0; i < intervals_.size(); ++i) {
      axis += m(intervals_[i]);
      const double right = i + 1 == intervals_.size() ? axis + m(1) : axis;
      const double from = left + (i > 0 ? joint : 0), to = right - (i + 1 < intervals_.size() ? joint : 0);
      const std::string name = "architrave" + std::to_string(i + 1);
      place(makeArchitrave(p_, to - from, chipsOf(name)), name,
            {(from + to) / 2, 0, level_ + m(e.architrave_height) / 2});
      left = right;
    }
    level_ += m(e.architrave_height);
    setFrieze();
    setCornice();
  }

  void setFrieze() {
    const Proportions::Entablature& e = *p_.entablature;
    const double height = m(e.frieze_height + e.band_height), spacing = m(e.triglyphSpacing());
    const auto last = static_cast<int>(std::lround(span_ / spacing));
    const double half_metope = m(std::max(0.0, 1 - e.triglyph_width / 2));
    for (int i = 0; i <= last; ++i) {
      const double axis = -span_ / 2 + i * spacing, beside = i == 0 ? -half_metope : i == last ? half_metope : 0;
      const std::string name = "triglyph" + std::to_string(i + 1);
      Block block = makeTriglyph(p_, beside, chipsOf(name));
      // a corner block ends with its half metope on the outside and half a joint before its only neighbour
      const double shift = beside == 0 ? 0 : beside / 2 + std::copysign(p_.stone.joint / 4, beside);
      place(std::move(block), name, {axis + shift, 0, level_ + height / 2});
      if (i == last) break;
      const std::string metope = "metope" + std::to_string(i + 1);
      place(makeMetope(p_, chipsOf(metope)), metope, {axis + spacing / 2, 0, level_ + height / 2});
    }
    level_ += height;
  }

  void setCornice() {
    const Proportions::Entablature& e = *p_.entablature;
    cornice_ = span_ + 2 * m(1 + e.cornice_projection);
    const double each = cornice_ / e.cornice_blocks, height = m(e.cornice_height);
    for (int i = 0; i < e.cornice_blocks; ++i) {
      const std::string name = "cornice" + std::to_string(i + 1);
      place(makeCornice(p_, each - p_.stone.joint, chipsOf(name)), name,
            {-cornice_ / 2 + (i + 0.5) * each, 0, level_ + height / 2});
    }
    level_ += height;
  }

  void setPediment() {
    const Proportions::Pediment& pediment = *p_.pediment;
    const double rise = pediment.height * cornice_, half = cornice_ / 2, slope = std::atan(rise / half);
    // cut off the thin end of the wedge, which would be a blade
    const double toe = m(0.35), from = toe / std::tan(slope), length = half - from - p_.stone.joint / 2;
    const double end = toe + length * std::tan(slope);
    for (const int side : {-1, 1}) {
      const std::string name = side < 0 ? "tympanum_left" : "tympanum_right";
      place(makeTympanum(p_, length, side < 0 ? toe : end, side < 0 ? end : toe, chipsOf(name)), name,
            {side * (half - from - length / 2), 0, level_ + end / 2});
    }
    const double ramp = half / std::cos(slope), raking = m(pediment.raking_height), tile = m(pediment.tile_height);
    const double joint = p_.stone.joint / 2;
    for (const int side : {-1, 1}) {
      const std::string name = side < 0 ? "left" : "right";
      const Quat q_WB(Eigen::AngleAxisd(side * slope, Vec3::UnitY()));
      // point at distance `up` from the eaves along the slope and `off` normal to it
      const auto at = [&](double up, double off) {
        const Vec3 along(-side * std::cos(slope), 0, std::sin(slope)), out(side * std::sin(slope), 0, std::cos(slope));
        return Vec3(Vec3(side * half, 0, level_) + up * along + off * out);
      };
      const auto closed = [&](Block block) {
        mitre(block, -side, std::tan(slope));
        return block;
      };
      place(closed(makeRakingCornice(p_, ramp - 2 * joint, chipsOf("raking_cornice_" + name))),
            "raking_cornice_" + name, at(ramp / 2, raking / 2), q_WB);
      for (int i = 0; i < pediment.tiles; ++i) {
        const double each = ramp / pediment.tiles;
        const std::string tile_name = "tile_" + name + std::to_string(i + 1);
        const bool top = i + 1 == pediment.tiles;
        // at the ridge its lower edge reaches the other slope's
        const double further = top ? raking * std::tan(slope) : 0;
        Block block = makeTile(p_, each + further - 2 * joint, chipsOf(tile_name));
        place(top ? closed(std::move(block)) : std::move(block), tile_name,
              at((i + 0.5) * each + further / 2, raking + tile / 2), q_WB);
      }
    }
  }

  const Proportions& p_;
  const double behind_;
  const std::uint64_t seed_;
  Building building_;
  std::vector<double> intervals_;
  double span_ = 0, cornice_ = 0, level_ = 0;  // [m]
};

}  // namespace

Building makeBuilding(const Proportions& proportions, double behind, std::uint64_t seed) {
  return Builder(proportions, behind, seed).build();
}

}  // namespace presa::temple
