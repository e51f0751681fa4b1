#include "modules/pointshell/balance.h"

#include <algorithm>
#include <limits>

namespace presa {
namespace {

constexpr int kIterations = 10;       // of Newton's method in a tick
constexpr double kBalanced = 1e-6;    // residual relative to the coupling's limits
constexpr double kNearly = 1e-4;      // the same, where another iteration no longer helps
constexpr double kDamped = 0.5;       // of the last step, where the next one goes back
constexpr int kPatience = 3;          // ticks out of balance in a row before a tool leaves its best pose
constexpr double kOnItsWay = 2;       // motion in a tick, over that of an iteration, that leads somewhere
constexpr double kNormalsHold = 0.2;  // of the max motion in an iteration: the normals of a smaller one stay

/// X_WT after a step in T.
Pose stepped(const Pose& X_WT, const Vec6& step_T) noexcept {
  const Mat3 R_WT = X_WT.q.toRotationMatrix();
  return movedBy(X_WT, (Vec6() << R_WT * step_T.head<3>(), R_WT * step_T.tail<3>()).finished());
}

}  // namespace

double BalanceSearch::relative(const Vec6& wrench) const noexcept {
  return std::max(wrench.head<3>().norm() / held_.coupling.max_force,
                  wrench.tail<3>().norm() / held_.coupling.max_torque);
}

double BalanceSearch::wayBetween(const Pose& from, const Pose& to) const noexcept {
  return (to.p - from.p).norm() + turnBetween(from.q, to.q).norm() * held_.shell.radius();
}

// What acts on the tool if it touches nothing.
void BalanceSearch::pull(Balance& at) const noexcept {
  Vec6 moved, handle;
  moved << at.X_WT.p - start_.p, turnBetween(start_.q, at.X_WT.q);
  handle << input_.v_WH, input_.w_WH;
  const CouplingForce force =
      couplingForce(held_.coupling, input_.X_WH, at.X_WT, moved - input_.period * handle, input_.period);
  const Mat3 R_TW = at.X_WT.q.conjugate().toRotationMatrix();
  at.wrench_T << R_TW * force.wrench.head<3>(), R_TW * force.wrench.tail<3>();
  at.stiffness_T = force.stiffness;
  if (held_.coupling.damping_along) {  // else it is the same in all directions
    at.stiffness_T.topLeftCorner<3, 3>() = R_TW * force.stiffness.topLeftCorner<3, 3>() * R_TW.transpose();
    at.stiffness_T.bottomRightCorner<3, 3>() = R_TW * force.stiffness.bottomRightCorner<3, 3>() * R_TW.transpose();
  }
  if (!held_.mass) return;
  at.inertia_T = held_.mass->wrench(at.X_WT, input_.period, at.stiffness_T);
  at.wrench_T += at.inertia_T;
}

// A tool without mass is where the handle is.
Balance BalanceSearch::free() const noexcept {
  if (!held_.mass) return {.X_WT = input_.X_WH};
  Balance at{.X_WT = start_};
  for (int iteration = 0;; ++iteration) {
    pull(at);
    if (iteration == kIterations || relative(at.wrench_T) <= kBalanced) return at;
    at.X_WT = stepped(at.X_WT, at.stiffness_T.partialPivLu().solve(at.wrench_T));
  }
}

// Evaluates all forces. Returns the residual relative to the limits of the coupling.
double BalanceSearch::unbalanced(Balance& at) const noexcept {
  pull(at);
  at.residual_T = at.wrench_T + held_.contact->evaluate(at.X_WT, at.stiffness_T);
  return relative(at.residual_T);
}

// Max motion of a point in an iteration: in the air, up to the surface and as deep as the handle can press there.
double BalanceSearch::longestStep(const Balance& at) const noexcept {
  const double near = held_.contact->nearest();
  if (!(near > 0)) return step_;
  const double press = at.wrench_T.head<3>().norm() + 4 * at.wrench_T.tail<3>().norm() / held_.shell.radius();
  return near + std::min(step_, 2 * press / stiffness_);
}

bool BalanceSearch::settle(Balance& at) const noexcept {
  at.X_WT = start_;
  double left = kMarginSteps * step_;    // way within which all points are known
  Pose best = start_, touched = start_;  // the latter: the last one in contact
  double before = std::numeric_limits<double>::infinity(), least = before;
  Vec6 last = Vec6::Zero();
  double last_way = 0;
  held_.contact->forgetNormals();
  for (int iteration = 0;; ++iteration) {
    const double now = unbalanced(at);
    if (now <= kBalanced || (now <= kNearly && now > 0.5 * before)) return true;
    if (now < least) {
      least = now;
      best = at.X_WT;
    }
    if (!held_.contact->touching().empty()) touched = at.X_WT;
    if (iteration == kIterations || left <= 0) break;
    before = now;
    Vec6 step = at.stiffness_T.partialPivLu().solve(at.residual_T);
    const double way = step.head<3>().norm() + step.tail<3>().norm() * held_.shell.radius();
    double max = std::min(left, longestStep(at));
    // there and back again where points come and go: meet in the middle
    if (last.dot(step) < 0) max = std::min(max, kDamped * last_way);
    if (way > max) step *= max / way;
    last = step;
    last_way = std::min(way, max);
    left -= last_way;
    if (way > kNormalsHold * step_) held_.contact->forgetNormals();
    at.X_WT = stepped(at.X_WT, step);
  }
  // To and fro, it stays at the best pose. If it is late for some ticks and gets away from there, over an edge for
  // instance, it goes on.
  const bool balanced = least <= kNearly;
  const bool goes_on = held_.late >= kPatience && wayBetween(start_, touched) > kOnItsWay * step_;
  at.X_WT = !balanced && goes_on ? touched : best;
  unbalanced(at);
  return balanced;
}

}  // namespace presa
