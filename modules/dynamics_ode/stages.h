#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "modules/dynamics_ode/ode_options.h"

namespace presa::ode {

/// The stages of a dynamics step. A scene may use only some of them.
enum class Stage : std::size_t { kWake, kCollide, kExtrapolate, kFingers, kPredict, kSolve, kRotate, kPublish };

struct StageText {
  Stage stage;
  std::string what;       ///< Module::stages
  std::string functions;  ///< Module::stageFunctions
};
/// The stages that a scene uses, in order.
std::vector<StageText> listStages(const OdeOptions& options);

}  // namespace presa::ode
