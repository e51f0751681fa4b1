// One implicit Euler step of a rigid body [Harwin & Barrow 2013, 4.1.2]: with u the motion and turn of the step of length
// h, (M / h^2 + K + C / h) u = M v / h + wrench of the handle + contacts. Gyroscopic moments of so light a body are left
// out.
#include "modules/light_cursor/cursor.h"

#include <algorithm>

namespace presa {
namespace {

constexpr double kMaxStep = 0.004;  // motion of a point in a tick: 4 m/s [m]
constexpr double kAhead = 1e-4;     // contacts are found this far beyond the motion that the handle wants [m]
constexpr int kLooks = 2;           // for contacts in a tick

Mat3 crossMatrix(const Vec3& v) noexcept {
  Mat3 m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

}  // namespace

Cursor::Cursor(const ConvexSolid& tool, const std::vector<ConvexSolid>& bodies,
               const std::vector<FrictionCoefficients>& friction, const ToolCoupling& coupling,
               const MassProperties& inertia, const CursorLaw& law)
    : tool_(tool),
      coupling_(coupling),
      pairs_(tool, bodies),
      law_(law),
      contacts_(law.max_contacts),
      sticking_(law.stiffness, friction, ConvexPairs::kMaxNear) {
  for (const ConvexPart& part : tool_.parts) radius_ = std::max(radius_, part.centre_A.norm() + part.reach);
  p_TCm_ = inertia.center;
  const Mat3 arm = crossMatrix(p_TCm_);
  inertia_T_ = law.mass / inertia.volume * inertia.inertia - law.mass * arm * arm;
}

void Cursor::reset() noexcept {
  v_.setZero();
  of_handle_.setZero();
  contacts_.clear();
  sticking_.letGo();
  pairs_.forget();
}

Mat6 Cursor::massAt(const Quat& q_WT) const noexcept {
  const Mat3 R = q_WT.toRotationMatrix(), arm = crossMatrix(R * p_TCm_);
  Mat6 mass;
  mass << law_.mass * Mat3::Identity(), -law_.mass * arm, law_.mass * arm, R * inertia_T_ * R.transpose();
  return mass;
}

bool Cursor::findContacts(const Pose& X_WT, double margin) noexcept {
  contacts_.clear();
  const bool whole = pairs_.gather(X_WT, margin);
  pairs_.separate(X_WT, margin);
  for (const NearParts& pair : pairs_.near()) {
    if (pair.gap > margin) continue;
    Manifold manifold;
    pairs_.touch(pair, margin, manifold);
    for (int i = 0; i < manifold.count; ++i) {
      const Manifold::Point& point = manifold.points[static_cast<std::size_t>(i)];
      addDeepest({.p = point.p_W - X_WT.p,
                  .nhat = pair.nhat_W,
                  .gap = point.gap,
                  .pair = static_cast<std::uint32_t>(pairs_.indexOf(pair)),
                  .solid = pair.solid},
                 contacts_);
    }
  }
  return whole && contacts_.lost() == 0;
}

Cursor::Step Cursor::step(const ToolInput& input, const std::vector<Pose>& X_WB, Pose& X_WT) noexcept {
  const double h = input.period;
  Vec6 handle;
  handle << input.v_WH, input.w_WH;
  const CouplingForce force = couplingForce(coupling_, input.X_WH, X_WT, -h * handle, h);
  const Mat6 mass = massAt(X_WT.q);
  const ContactProblem problem{mass / (h * h) + force.stiffness, mass * v_ / h + force.wrench, law_.stiffness};
  const StepPoses poses{X_WT, X_WB};
  pairs_.place(input.touchables);
  sticking_.begin();
  Vec6 u = problem.Q.ldlt().solve(problem.r);
  const Step result = meet(problem, poses, u);
  v_ = u / h;
  const Pose moved = movedBy(X_WT, u);
  if (contacts_.empty()) {
    sticking_.letGo();
  } else {
    sticking_.keep(moved, poses, contacts_);
  }
  of_handle_ = couplingForce(coupling_, input.X_WH, moved, u - h * handle, h).wrench;
  X_WT = moved;
  return result;
}

// Contacts are found as far as the handle wants to move the tool; where they move it farther themselves, as a body does that
// comes towards it, once more as far as that.
Cursor::Step Cursor::meet(const ContactProblem& problem, const StepPoses& poses, Vec6& u) noexcept {
  const auto wayOf = [&](const Vec6& step) { return step.head<3>().norm() + radius_ * step.tail<3>().norm(); };
  Step result;
  double reach = wayOf(u) + kAhead;
  for (int look = 0; look < kLooks; ++look) {
    contacts_.clear();
    if (pairs_.clearance(poses.X_WT) < reach) result.whole = findContacts(poses.X_WT, reach);
    if (contacts_.empty()) return result;
    result.exact = solveWithFriction(problem, poses, sticking_, contacts_, u);
    if (wayOf(u) <= reach) break;
    reach = wayOf(u) + kAhead;
  }
  // along the way to a step that all planes allow, they allow every point
  const double way = wayOf(u), most = std::min(reach, kMaxStep);
  if (way > most) u *= most / way;
  return result;
}

}  // namespace presa
