#pragma once
#include <string>
#include <vector>

#include "modules/dynamics_ode/ode_options.h"

namespace presa::ode {

/// Module::stages: the stages of a dynamics step that a scene uses, in order.
std::vector<std::string> listStages(const OdeOptions& options);

}  // namespace presa::ode
