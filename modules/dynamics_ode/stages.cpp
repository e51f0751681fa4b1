#include "modules/dynamics_ode/stages.h"

namespace presa::ode {

std::vector<StageText> listStages(const OdeOptions& options) {
  using D = DynamicsSettings;
  const D& method = options.method;
  const std::string ode = "presa::ode::", read = ode + "FingerJoints::read", add = ode + "FingerJoints::addTo",
                    wake = ode + "OdeWorld::Impl::wakeTouched", sleep = ode + "Sleep::afterStep",
                    predict = ode + "StepSolver::predict", solve = ode + "StepSolver::solve",
                    rotate = ode + "BodySet::driftRotations", freeze = ode + "BodySet::freezeBroken",
                    publish = ode + "OdeWorld::write";
  const std::string iterations =
      method.iterations > 0 ? std::to_string(method.iterations) : "up to " + std::to_string(options.most_iterations);
  std::vector<StageText> all;
  if (method.sleeping) {
    all.push_back(
        {Stage::kWake, "wake what a finger or a moving body touches; what lies still sleeps", wake + " + " + sleep});
  }
  all.push_back(
      {Stage::kCollide,
       "collide the physics geometries, a step ahead of the touch (sort and sweep, at most 8 contacts per pair)",
       ode + "OdeWorld::Impl::step - " + ode + "OdeWorld::Impl::substep - " + wake + " - " + sleep});
  all.push_back({Stage::kExtrapolate,
                 "extrapolate each finger to the start of the step; a finger not heard of for 20 ms fades", read});
  all.push_back({Stage::kFingers,
                 method.coupling == D::Coupling::kSoft
                     ? "fingers as implicit spring-dampers (soft contact joints) inside their friction cone"
                     : "fingers as forces that act for one step",
                 add});
  if (method.friction == D::Friction::kIsotropic) {
    all.push_back({Stage::kPredict,
                   "where something slides, solve once without friction, to point friction along the coming slip",
                   predict});
  }
  all.push_back({Stage::kSolve,
                 method.solver == D::Solver::kDirect ? "solve all islands directly"
                 : method.solver == D::Solver::kIterative
                     ? "solve all islands with " + iterations + " iterations"
                     : "solve: islands up to " + std::to_string(options.direct_limit) +
                           " contacts directly, larger ones with " + iterations + " iterations",
                 solve + " - " + predict + " - " + add});
  if (method.rotation == D::Rotation::kExact) {
    all.push_back({Stage::kRotate, "rotate free bodies by one Runge-Kutta step of Euler's equations", rotate});
  }
  all.push_back({Stage::kPublish, "freeze a body whose state is not finite; publish poses at both ends of the step",
                 freeze + " + " + publish});
  return all;
}

}  // namespace presa::ode
