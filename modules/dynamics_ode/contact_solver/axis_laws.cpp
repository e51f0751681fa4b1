#include "modules/dynamics_ode/contact_solver/axis_laws.h"

#include "modules/dynamics_ode/contact_solver/joint_rows.h"

namespace presa::ode {
namespace {

void bound(AxisLaw& law, double impulse) noexcept {
  law.low = -impulse;
  law.high = impulse;
}

}  // namespace

bool hasLaws(const JointAxis& axis) noexcept {
  return axis.lower || axis.upper || axis.friction > 0 || axis.max_force > 0 || axis.hasSpring();
}

AxisLaws lawsOf(const JointAxis& axis, double position, double u, double k, double h) noexcept {
  const double fastest = axis.turns ? kMaxTurning : kMaxClosing;
  AxisLaws laws;
  if (axis.lower) {
    AxisLaw& law = laws.add(k);
    law.low = 0;
    law.goal = std::min((*axis.lower - position) / h, fastest);
  }
  if (axis.upper) {
    AxisLaw& law = laws.add(k);
    law.high = 0;
    law.goal = std::max((*axis.upper - position) / h, -fastest);
  }
  if (axis.friction > 0) bound(laws.add(k), h * axis.friction);
  if (axis.max_force > 0) {
    AxisLaw& law = laws.add(k);
    law.goal = axis.speed;
    bound(law, h * axis.max_force);
  }
  if (axis.stiffness > 0) laws.add(h * h * axis.stiffness / 4).goal = u + 4 * (axis.rest - position) / h;
  if (axis.damping > 0) laws.add(h * axis.damping);
  return laws;
}

double speedUnder(const AxisLaws& laws, double inertia, double free) noexcept {
  if (laws.count == 0) return free;
  // velocities below and above which a law gives no more
  const auto above = [](const AxisLaw& law) { return law.goal - law.high / law.k; };
  const auto below = [](const AxisLaw& law) { return law.goal - law.low / law.k; };
  const auto isTooSlow = [&](double u) {
    double impulse = 0;
    for (const AxisLaw& law : laws.all()) impulse += law.clamped(law.springAt(u));
    return inertia * (u - free) < impulse;
  };
  double from = -AxisLaw::kUnbounded, to = AxisLaw::kUnbounded;
  for (const AxisLaw& law : laws.all()) {
    for (const double u : {above(law), below(law)}) {
      if (u <= from || u >= to) continue;
      (isTooSlow(u) ? from : to) = u;
    }
  }
  double impulse = inertia * free, stiffness = inertia;
  for (const AxisLaw& law : laws.all()) {
    if (to <= above(law)) {
      impulse += law.high;
    } else if (from >= below(law)) {
      impulse += law.low;
    } else {
      impulse += law.k * law.goal;
      stiffness += law.k;
    }
  }
  return impulse / stiffness;
}

}  // namespace presa::ode
