// The ray takes the pose of minimum energy of the handle's springs among those that the bodies allow. Its distance from
// a body is linear around a pose, the contact problem gives a better pose, and the distances are found there again:
// Newton's method on the exact gaps of the few triangles that hold it. In a part of a tick no point of the axis moves
// farther than the axis was from everything at one pose of that part, so that it cannot cross a surface, however thin.
#include "modules/ray/ray_proxy.h"

#include <algorithm>

namespace presa {
namespace {

constexpr double kFarthest = 0.004;            // way of a point in a part of a tick [m]
constexpr double kSafe = 0.9;                  // max share of the clearance that a part of a tick uses
constexpr double kAhead = RayProxy::kMinStep;  // places are looked for this far beyond the way [m]
constexpr double kSettled = 5e-6;              // change of the pose at which the looks end [m]
constexpr double kRoom = 1e-4;                 // of the first part, beyond the last tick's way times kGrowth [m]
constexpr double kGrowth = 1.5;
constexpr double kEased = 0.005;  // change of the friction of all places together at which the looks end [N]
constexpr double kNearest = 1 - RayProxy::kMaxOverlap;  // of the radius: with less clearance a part is taken back
constexpr int kParts = 4;                               // of a tick
constexpr int kLooks = 12;                              // in a part

/// The handle resists motion and turn apart from each other.
Mat6 inverseOf(const Mat6& stiffness) noexcept {
  Mat6 inverse = Mat6::Zero();
  inverse.topLeftCorner<3, 3>() = stiffness.topLeftCorner<3, 3>().inverse();
  inverse.bottomRightCorner<3, 3>() = stiffness.bottomRightCorner<3, 3>().inverse();
  return inverse;
}

}  // namespace

RayProxy::RayProxy(const Ray& ray, const ConvexSolid& tool, const RayBodies& bodies, const TouchedSolids& solids,
                   const ToolCoupling& coupling, double stiffness)
    : ray_(ray),
      solids_(solids),
      coupling_(coupling),
      near_(ray, tool, bodies),
      stiffness_(stiffness),
      radius_(std::max(ray.axis_T.a.norm(), ray.axis_T.b.norm()) + ray.radius),
      points_(kMaxPoints),
      found_(kMaxPoints),
      sticking_(stiffness, solids.friction(), solids.friction().size()) {}

void RayProxy::reset() noexcept {
  of_handle_.setZero();
  expected_.setZero();
  friction_.setZero();
  points_.clear();
  sticking_.letGo();
  near_.forget();
  carried_ = false;
}

// A ray at rest on a moving body is at rest.
void RayProxy::carry(Pose& X_WT) noexcept {
  if (!carried_) return;
  const Pose& now = solids_.X_WB()[carrier_];
  X_WT = now * (X_WB_.inverse() * X_WT);
}

RayProxy::Step RayProxy::step(const ToolInput& input, Pose& X_WT) noexcept {
  Step result;
  const Pose before = X_WT;
  carry(X_WT);
  near_.place(input.touchables, solids_.X_WB());
  Vec6 carried;
  carried << X_WT.p - before.p, turnBetween(before.q, X_WT.q);
  Vec6 moved = carried;
  // the first part is about as long as the last tick was, so that fewer triangles are looked at
  double farthest = kRoom + kGrowth * wayOf(expected_);
  for (int part = 0; part < kParts && !move(input, farthest, X_WT, moved, result); ++part) {
    expected_.setZero();
    farthest = kFarthest;
  }
  expected_ = moved - carried;
  of_handle_ = handleAt(input, X_WT, moved).wrench;
  const auto* most = std::max_element(points_.begin(), points_.end(),
                                      [](const PressedPoint& a, const PressedPoint& b) { return a.force < b.force; });
  carried_ = most != points_.end() && most->force > 0;
  if (carried_) {
    carrier_ = most->solid;
    X_WB_ = solids_.X_WB()[carrier_];
  }
  return result;
}

CouplingForce RayProxy::handleAt(const ToolInput& input, const Pose& X_WT, const Vec6& moved) const noexcept {
  Vec6 handle;
  handle << input.v_WH, input.w_WH;
  return couplingForce(coupling_, input.X_WH, X_WT, moved - input.period * handle, input.period);
}

bool RayProxy::move(const ToolInput& input, double farthest, Pose& X_WT, Vec6& moved, Step& result) noexcept {
  const CouplingForce force = handleAt(input, X_WT, moved);
  const Mat6 inverse = inverseOf(force.stiffness);
  const ContactProblem problem{force.stiffness, force.wrench, stiffness_, &inverse};
  Vec6 u = inverse * problem.r;
  const double most = std::min({std::max(wayOf(u), wayOf(expected_)) + kAhead, farthest, kFarthest});
  points_.clear();
  Settled settled{true, wayOf(u) <= most};
  if (near_.begin(X_WT, most)) {
    sticking_.begin(true);
    settled = settle(problem, {X_WT, solids_.X_WB()}, most, u);
    near_.keep();
    result.whole = result.whole && near_.whole() && points_.lost() == 0;
    result.exact = result.exact && settled.exact;
  } else if (!settled.arrived) {
    u *= most / wayOf(u);
  }
  const Pose begin = X_WT;
  X_WT = movedBy(X_WT, u);
  moved += u;
  if (points_.empty()) {
    sticking_.letGo();
  } else {
    sticking_.keep(X_WT, {begin, solids_.X_WB()}, points_);
  }
  return settled.arrived;
}

RayProxy::Settled RayProxy::settle(const ContactProblem& problem, const StepPoses& poses, double most,
                                   Vec6& u) noexcept {
  const bool rough =
      std::any_of(solids_.friction().begin(), solids_.friction().end(),
                  [](const FrictionCoefficients& one) { return one.mu_static > 0 || one.mu_dynamic > 0; });
  if (!rough) sticking_.letGo();
  const Vec6 free = u;
  // The first look is at the pose that the last tick makes likely. No point of the axis may move farther than its clearance
  // there, neither on the way to it nor from it.
  Vec6 centre = wayOf(expected_) <= most ? expected_ : Vec6(Vec6::Zero());
  near_.look(movedBy(poses.X_WT, centre), points_);
  if (wayOf(centre) > kSafe * near_.clearance()) {
    centre.setZero();
    near_.look(poses.X_WT, points_);
  }
  const double clearance = near_.clearance();
  const double around = std::min(most - wayOf(centre), std::max(kSafe * clearance, kAhead));
  Vec6 at = centre;  // step of the last look
  Settled result;
  for (int look = 0; look < kLooks; ++look) {
    if (look > 0) near_.look(movedBy(poses.X_WT, at), points_);
    for (PressedPoint& one : points_) {
      Vec6 row;
      row << one.nhat, one.p.cross(one.nhat);
      one.gap -= row.dot(at);
    }
    if (points_.empty()) {
      u = free;
      result.exact = true;
    } else {
      result.exact =
          rough ? solveWithFriction(problem, poses, sticking_, points_, u) : solveContacts(problem, points_, u).exact;
    }
    const double way = wayOf(u - centre);
    result.arrived = way <= around;
    if (!result.arrived) u = centre + around / way * (u - centre);
    const double change = wayOf(u - at);
    at = u;
    Vec3 friction = Vec3::Zero();
    for (const PressedPoint& one : points_) friction += one.friction;
    const double eased = (friction - friction_).norm();
    friction_ = friction;
    if (result.exact && change <= kSettled && eased <= kEased) break;
    if (look + 1 < kLooks) continue;
    result.exact = false;
    near_.look(movedBy(poses.X_WT, u), found_);
  }
  if (near_.clearance() < std::min(clearance, kNearest * ray_.radius)) {
    stay(problem, poses, u);
    result.exact = false;
  }
  return result;
}

// The forces are those that the handle asks for at the pose where the ray stays.
void RayProxy::stay(const ContactProblem& problem, const StepPoses& poses, Vec6& u) noexcept {
  u.setZero();
  near_.look(poses.X_WT, points_);
  Vec6 wanted = u;
  solveContacts(problem, points_, wanted);
}

}  // namespace presa
