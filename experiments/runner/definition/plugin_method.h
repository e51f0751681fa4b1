#pragma once
#include <memory>

#include "experiments/runner/psychophysics/axis.h"
#include "experiments/runner/psychophysics/method.h"
#include "framework/core/math/random.h"
#include "framework/scene/plugin_element.h"

namespace presa::experiment {

/// A method that a plug-in brings, held to its contract: E617 (InputError, with the element's place) when a level is no
/// finite number, when it wants more answers than its max_trials, or when it throws. Throws the errors of pluginTable,
/// and E596 when the plug-in cannot make it.
std::unique_ptr<psychophysics::Method> makePluginMethod(const PluginElement& element, const psychophysics::Axis& axis,
                                                        const RandomStream& stream);

/// Upper bound on the answers until the method has finished; E617 when it is 0.
std::size_t maxTrials(const PluginElement& element);

}  // namespace presa::experiment
