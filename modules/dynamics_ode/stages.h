#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "modules/dynamics_ode/ode_options.h"

namespace presa::ode {

/// The parts of a dynamics step; a scene may do without some.
enum class Stage : std::size_t { kWake, kCollide, kExtrapolate, kFingers, kPredict, kSolve, kRotate, kPublish };

struct StageText {
  Stage stage;
  std::string what;       ///< Module::stages
  std::string functions;  ///< Module::stageFunctions
};
/// Those of a scene, in their order.
std::vector<StageText> listStages(const OdeOptions& options);

}  // namespace presa::ode
