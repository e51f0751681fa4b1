#include "framework/grasp/quality.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "framework/grasp/growing_hull.h"

namespace presa {
namespace {

constexpr double kLeftOut = 0.05;  // a weight that swings by 3 degrees
constexpr double kProof = 1e-9;    // beyond rounding, of wrenches of about 1 N
constexpr double kNever = std::numeric_limits<double>::infinity();

/// Of all wrenches that pressing contacts exert, about the one nearest to 0 [Gilbert1966]: the body evades along it
/// most. None unless it proves that the contacts push to one side: no wrench of theirs works against it.
std::optional<Vec6> pushedTo(const WrenchSpace& space) {
  Vec6 nearest = Vec6::Zero(), next = Vec6::Zero();
  space.pressing(Vec6::UnitX(), nearest);
  for (int i = 0; i < 2000 && nearest.norm() > 0; ++i) {
    space.pressing(-nearest, next);
    const Vec6 step = next - nearest;
    if (-nearest.dot(step) <= 1e-9 * nearest.squaredNorm()) break;
    nearest += std::clamp(-nearest.dot(step) / step.squaredNorm(), 0.0, 1.0) * step;
  }
  if (!(nearest.norm() > kProof) || space.pressing(-nearest.normalized(), next) > -kProof) return std::nullopt;
  return nearest.normalized();
}

/// Of the motions across the span, the one that a person would name: a turn about a line between two contacts, or else
/// the part of one axis that lies across most.
Vec6 namedAcross(const GraspSnapshot& grasp, const WrenchBasis& span) {
  const Eigen::Matrix<double, 6, 6> across = Eigen::Matrix<double, 6, 6>::Identity() - span * span.transpose();
  Vec6 best = Vec6::Zero();
  const auto offer = [&](const Vec6& motion) {
    const Vec6 part = across * motion.normalized();
    if (part.norm() > best.norm() + 1e-6) best = part;
  };
  for (const GraspContact& a : grasp.contacts) {
    for (const GraspContact& b : grasp.contacts) {
      const Vec3 w = b.p - a.p;
      if (&a >= &b || !(w.norm() > 0)) continue;
      Vec6 turn;
      turn << w.cross(grasp.centre - a.p), grasp.length * w;
      offer(turn);
    }
  }
  for (Eigen::Index i = 0; i < 6; ++i) offer(Vec6::Unit(i));
  return best.normalized();
}

/// The space may resist nothing that the basis leaves out.
struct Load {
  Eigen::VectorXd within;
  bool held = false;
};

Load loadWithin(const GraspSnapshot& grasp, const WrenchBasis& basis, const Wrench& load) {
  Vec6 all;
  all << load.f, load.t / grasp.length;
  const Eigen::VectorXd within = basis.transpose() * -all;
  return {within, (all + basis * within).norm() <= kLeftOut * all.norm()};
}

ProvenBounds factorOf(const GraspSnapshot& grasp, const Wrench& load) {
  const WrenchSpace space(grasp, GripBound::kEach);
  const WrenchBasis basis = space.span();
  const Load wanted = loadWithin(grasp, basis, load);
  if (!wanted.held) return {};
  const double size = wanted.within.norm();
  if (!(size > 0)) return {kNever, kNever};
  const auto figure = [&](const Eigen::VectorXd& normal, double offset) {
    const double against = normal.dot(wanted.within);
    return against > 1e-9 * size ? offset / against : kNever;
  };
  return smallestFigure(space, basis, figure).bounds;
}

}  // namespace

GraspQuality graspQuality(const GraspSnapshot& grasp, GripBound bound) {
  const WrenchSpace space(grasp, bound);
  const WrenchBasis basis = space.span();
  GraspQuality quality;
  quality.unopposed = 6 - static_cast<int>(basis.cols());
  if (const std::optional<Vec6> pushed = pushedTo(space)) {
    quality.weakest = *pushed;
    return quality;
  }
  const HullFigure radius = smallestFigure(space, basis, [](const Eigen::VectorXd&, double offset) { return offset; });
  quality.within_span = radius.bounds;
  if (!(radius.bounds.at_least > 0)) {
    quality.weakest = -(basis * radius.normal);
    return quality;
  }
  quality.closure = quality.unopposed > 0 ? GraspClosure::kPartial : GraspClosure::kFull;
  if (quality.closure == GraspClosure::kFull) quality.epsilon = radius.bounds;
  quality.weakest = quality.unopposed > 0 ? namedAcross(grasp, basis) : Vec6(-(basis * radius.normal));
  return quality;
}

ProvenBounds loadFactor(const GraspSnapshot& grasp, const Wrench& load) { return factorOf(grasp, load); }

ProvenBounds minGrip(const GraspSnapshot& grasp, const Wrench& load) {
  GraspSnapshot alike = grasp;
  for (GraspContact& contact : alike.contacts) contact.max_normal = 1;
  const ProvenBounds factor = factorOf(alike, load);
  const auto inverse = [](double x) { return x > 0 ? 1 / x : kNever; };
  return {inverse(factor.at_most), inverse(factor.at_least)};
}

}  // namespace presa
