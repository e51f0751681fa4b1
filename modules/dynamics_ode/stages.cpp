#include "modules/dynamics_ode/stages.h"

namespace presa::ode {

std::vector<std::string> listStages(const OdeOptions& options) {
  using D = DynamicsSettings;
  const D& method = options.method;
  const std::string iterations =
      method.iterations > 0 ? std::to_string(method.iterations) : "up to " + std::to_string(options.max_iterations);
  std::vector<std::string> all;
  if (method.sleeping) all.emplace_back("wake bodies that a finger or a moving body touches; bodies at rest sleep");
  all.emplace_back(
      "collide the physics geometries, a step ahead of the contact (sort and sweep, at most 8 contacts per pair)");
  all.emplace_back("extrapolate each finger to the start of the step; a finger without a sample for 20 ms fades");
  all.emplace_back(method.coupling == D::Coupling::kSoft
                       ? "fingers as implicit spring-dampers (soft contact joints) inside their friction cone"
                       : "fingers as forces that act for one step");
  if (method.friction == D::Friction::kIsotropic) {
    all.emplace_back("for sliding contacts, solve once without friction to find the direction of slip");
  }
  all.push_back(method.solver == D::Solver::kDirect ? "solve all islands directly"
                : method.solver == D::Solver::kIterative
                    ? "solve all islands with " + iterations + " iterations"
                    : "solve: islands up to " + std::to_string(options.direct_limit) +
                          " contacts directly, larger ones with " + iterations + " iterations");
  if (method.rotation == D::Rotation::kExact) {
    all.emplace_back("rotate free bodies by one Runge-Kutta step of Euler's equations");
  }
  all.emplace_back("freeze a body whose state is not finite; publish poses at both ends of the step");
  return all;
}

}  // namespace presa::ode
