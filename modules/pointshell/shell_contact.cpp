#include "modules/pointshell/shell_contact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

namespace presa {
namespace {

Vec6 wrenchOf(const Vec3& f, const Vec3& p) noexcept {
  Vec6 wrench;
  wrench << f, p.cross(f);
  return wrench;
}

}  // namespace

ShellContact::ShellContact(const PointShell& shell, const std::vector<Solid>& solids, const std::vector<Pose>& X_WB,
                           const std::vector<FrictionCoefficients>& friction, const ShellLaw& law)
    : shell_(shell),
      solids_(solids),
      X_WB_(X_WB),
      friction_(friction),
      law_(law),
      X_TB_(solids.size()),
      X_BT_gathered_(solids.size()),
      near_(kMaxNear),
      touching_(kMaxNear),
      holds_(shell.size()),
      held_(kMaxNear),
      next_held_(kMaxNear),
      slides_(solids.size(), 0),
      stretch_B_(solids.size(), Vec3::Zero()),
      sums_(solids.size(), Eigen::Vector4d::Zero()) {}

double ShellContact::clearance(const Pose& X_WT) const noexcept {
  double clearance = std::numeric_limits<double>::infinity();
  for (std::size_t s = 0; s < solids_.size(); ++s)
    clearance = std::min(clearance, solids_[s].lowerBound(X_WB_[s].inverseTimes(X_WT.p)) - shell_.radius());
  return clearance;
}

bool ShellContact::stillHolds(const Pose& X_WT, double margin) const noexcept {
  for (std::size_t s = 0; s < solids_.size(); ++s) {
    const Pose X_BT = X_WB_[s].inverse() * X_WT;
    const Pose& before = X_BT_gathered_[s];
    const double way = (X_BT.p - before.p).norm() + turnBetween(before.q, X_BT.q).norm() * shell_.radius();
    if (way + margin > reach_) return false;
  }
  return true;
}

bool ShellContact::gather(const Pose& X_WT, double margin, double ahead) noexcept {
  if (stillHolds(X_WT, margin)) return whole_;
  margin += ahead;
  reach_ = margin;
  whole_ = false;
  for (std::size_t s = 0; s < solids_.size(); ++s) X_BT_gathered_[s] = X_WB_[s].inverse() * X_WT;
  near_.clear();
  examined_ = 0;
  ++gathering_;
  for (const PointShell::Level& level : shell_.levels()) {
    const std::size_t before = near_.size();
    for (std::size_t s = 0; s < solids_.size(); ++s) {
      const Pose& X_BT = X_BT_gathered_[s];
      if (solids_[s].lowerBound(X_BT.p) > shell_.radius() + margin) continue;
      if (gatherFrom(static_cast<std::uint32_t>(s), X_BT, margin, level)) continue;
      // a level counts as a whole, so that the points cover the tool evenly; the first one is better than none
      while (before > 0 && near_.size() > before) near_.remove(near_.size() - 1);
      return false;
    }
  }
  return whole_ = true;
}

bool ShellContact::gatherFrom(std::uint32_t s, const Pose& X_BT, double margin,
                              const PointShell::Level& level) noexcept {
  const SeenSolid solid(solids_[s], X_BT);
  const auto is_far = [&](const PointShell::Ball& ball) {
    return solid.lowerBound(ball.center) > static_cast<double>(ball.radius) + margin;
  };
  for (std::uint32_t g = level.first_group; g < level.end_group; ++g) {
    const PointShell::Range& group = shell_.groups()[g];
    if (is_far(group.ball)) continue;
    for (std::uint32_t b = group.first; b < group.end; ++b) {
      const PointShell::Range& block = shell_.blocks()[b];
      if (is_far(block.ball)) continue;
      examined_ += block.end - block.first;
      if (examined_ > law_.budget) return false;
      const auto points_T = std::span(shell_.points()).subspan(block.first, block.end - block.first);
      std::array<float, FieldSweep::kMax> distance;
      solid.distances(points_T, distance);
      for (std::uint32_t i = block.first; i < block.end; ++i) {
        if (!(static_cast<double>(distance[i - block.first]) < margin)) continue;
        Hold& hold = holds_[i];
        const bool is_new = hold.gathering + 1 != gathering_ && hold.gathering != gathering_;
        if (near_.add({points_T[i - block.first], i, s, is_new}) == nullptr) return false;
        hold.gathering = gathering_;
      }
    }
  }
  return true;
}

const Vec3& ShellContact::normalOf(NearPoint& near, const SeenSolid& solid) const noexcept {
  if (near.normal_of != normals_) {
    near.normal_of = normals_;
    near.nhat_T = solid.normal(near.p_T);
  }
  return near.nhat_T;
}

// Points of a solid come in a row.
void ShellContact::findTouching(const Pose& X_WT) noexcept {
  touching_.clear();
  nearest_ = std::numeric_limits<double>::infinity();
  std::optional<SeenSolid> solid;
  for (std::size_t first = 0, end = 0; first < near_.size(); first = end) {
    const std::uint32_t seen = near_[first].solid;
    if (first == 0 || near_[first - 1].solid != seen) solid.emplace(solids_[seen], X_WB_[seen].inverse() * X_WT);
    SeenPoints points(*solid);
    for (; end < near_.size() && near_[end].solid == seen && points.count() < SeenPoints::kMax; ++end)
      points.add(near_[end].p_T);
    points.lookUp();
    for (std::size_t i = 0; i < points.count(); ++i) {
      nearest_ = std::min(nearest_, points.distance(i));
      NearPoint& near = near_[first + i];
      if (law_.printed)
        touchAsPrinted(near, *solid);
      else if (points.distance(i) < 0)
        touching_.add({.point = near.point,
                       .solid = seen,
                       .p_T = near.p_T.cast<double>(),
                       .nhat_T = normalOf(near, *solid),
                       .slope_T = points.slope(i),
                       .depth = -points.distance(i),
                       .is_new = near.is_new});
    }
  }
}

// Along the tool's own normal: the force turns with the tool.
void ShellContact::touchAsPrinted(const NearPoint& near, const SeenSolid& solid) noexcept {
  const Vec3 nhat_T = -shell_.normals()[near.point].cast<double>(), p_T = near.p_T.cast<double>();
  Vec3 center_T = Vec3::Zero();
  const double depth = -solid.voxelAt(near.p_T, center_T) + (center_T - p_T).dot(nhat_T);
  if (!(depth > 0)) return;
  touching_.add({.point = near.point,
                 .solid = near.solid,
                 .p_T = p_T,
                 .nhat_T = nhat_T,
                 .slope_T = nhat_T,
                 .depth = depth,
                 .is_new = near.is_new});
}

// The mean of the depths, weighted by them: continuous when a point comes or goes, and as stiff for one point as for
// many. With d = depth, S the sum of the depths and w = d / S, the force of a point is k w (d n + t), where t is its
// stretch, or mu d along it where it slips. Its derivative has the point's own motion, and dS, which is the same for all.
Vec6 ShellContact::evaluate(const Pose& X_WT, Mat6& stiffness) noexcept {
  for (std::size_t s = 0; s < solids_.size(); ++s) X_TB_[s] = X_WT.inverse() * X_WB_[s];
  findTouching(X_WT);
  double depths = 0;
  for (const TouchingPoint& one : touching_) depths += one.depth;
  Vec6 wrench = Vec6::Zero(), sum = Vec6::Zero(), by_sum = Vec6::Zero();
  for (TouchingPoint& one : touching_) {
    one.weight = law_.printed ? 1 / static_cast<double>(touching_.size()) : one.depth / depths;
    const double k = law_.stiffness * one.weight;
    const Tangential tangential = frictionOf(one);
    const Vec6 normal = wrenchOf(one.nhat_T, one.p_T), along = wrenchOf(tangential.stretch, one.p_T);
    const Vec6 slope = wrenchOf(one.slope_T, one.p_T);  // against motion and turn of the tool
    one.f_T = k * (one.depth * one.nhat_T + tangential.stretch);
    wrench += k * (one.depth * normal + along);
    addStiffness(k * tangential.resistance, one.p_T, stiffness);
    if (law_.printed) {
      stiffness += k * (normal + (one.slips ? 1 / one.depth : 0.0) * along) * slope.transpose();
      continue;
    }
    stiffness += (2 * k * normal + (one.slips ? 2 : 1) * law_.stiffness / depths * along) * slope.transpose();
    by_sum += k * (one.weight * normal + along / depths);
    sum += slope;
  }
  stiffness -= by_sum * sum.transpose();
  return wrench;
}

// A point that was not looked at before, because a coarser level sufficed, shares the stretch of the others.
Vec3 ShellContact::stretchOf(const TouchingPoint& one, bool held) const noexcept {
  const Pose& X_TB = X_TB_[one.solid];
  Vec3 stretch = held         ? Vec3(X_TB * holds_[one.point].anchor_B - one.p_T)
                 : one.is_new ? Vec3(X_TB.q * stretch_B_[one.solid])
                              : Vec3(Vec3::Zero());
  return stretch - stretch.dot(one.nhat_T) * one.nhat_T;
}

ShellContact::Tangential ShellContact::frictionOf(TouchingPoint& one) const noexcept {
  const FrictionCoefficients& mu = friction_[one.solid];
  const bool held = holds_[one.point].solid == static_cast<std::int32_t>(one.solid);
  one.slips = true;
  if (!(mu.mu_static > 0) || !(held || one.is_new)) return {};
  Tangential tangential{stretchOf(one, held), Mat3::Identity() - one.nhat_T * one.nhat_T.transpose()};
  const double length = tangential.stretch.norm();
  const double max = (slides_[one.solid] != 0 ? mu.mu_dynamic : mu.mu_static) * one.depth;
  one.slips = length > max;
  if (!one.slips) return tangential;
  const Vec3 along = tangential.stretch / length;
  tangential.stretch = max * along;
  tangential.resistance = max / length * (tangential.resistance - along * along.transpose());
  return tangential;
}

// A contact slides, and has dynamic friction, once all of its points slip. While some stick, those that slip keep the
// bound of static friction: the block as a whole then starts to slide where Coulomb says, however its pressure is spread.
void ShellContact::keepHolds() noexcept {
  constexpr double kAtBound = 1 - 1e-9;  // of the stretch that a dragged point keeps
  const auto marked = [](std::int32_t solid) { return -solid - 2; };
  for (const std::uint32_t i : held_) holds_[i].solid = marked(holds_[i].solid);
  next_held_.clear();
  for (std::size_t s = 0; s < solids_.size(); ++s) {
    slides_[s] = static_cast<char>(slides_[s] != 0 ? kSlid : 0);
    sums_[s].setZero();
  }
  for (const TouchingPoint& one : touching_) {
    Hold& hold = holds_[one.point];
    const auto solid = static_cast<std::int32_t>(one.solid);
    const bool held = hold.solid == marked(solid);
    char& slides = slides_[one.solid];
    const FrictionCoefficients& mu = friction_[one.solid];
    const double max = ((slides & kSlid) != 0 ? mu.mu_dynamic : mu.mu_static) * one.depth;
    Vec3 stretch = stretchOf(one, held);
    const double length = stretch.norm();
    if (length > max) stretch *= max / length;  // dragged along
    if (held) slides = static_cast<char>(slides | (length > kAtBound * max ? kSlips : kSticks));
    if (!held || length > max) hold.anchor_B = X_TB_[one.solid].inverseTimes(one.p_T + stretch);
    sums_[one.solid] += (Eigen::Vector4d() << one.weight * stretch, one.weight).finished();
    hold.solid = solid;
    next_held_.add(one.point);
  }
  for (std::size_t s = 0; s < solids_.size(); ++s) {
    slides_[s] = static_cast<char>((slides_[s] & (kSlips | kSticks)) == kSlips);
    stretch_B_[s] =
        sums_[s][3] > 0 ? Vec3(X_TB_[s].q.conjugate() * sums_[s].head<3>() / sums_[s][3]) : Vec3(Vec3::Zero());
  }
  for (const std::uint32_t i : held_) {
    if (holds_[i].solid < 0) holds_[i].solid = -1;  // touches no more
  }
  held_ = next_held_;
  for (NearPoint& near : near_) near.is_new = false;
}

void ShellContact::letGo() noexcept {
  for (const std::uint32_t i : held_) holds_[i].solid = -1;
  held_.clear();
  for (std::size_t s = 0; s < solids_.size(); ++s) {
    slides_[s] = 0;
    stretch_B_[s].setZero();
  }
}

}  // namespace presa
