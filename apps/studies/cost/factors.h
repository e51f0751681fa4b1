#pragma once
#include <string>
#include <vector>

#include "apps/studies/cost/study.h"

namespace presa::cost {

/// A factor, given by name or by path, with values from the command line or a study file. `folder`: folder of decimated
/// meshes; `where`: position of the factor for messages. Errors (E801 unknown name, E802 no usable value) go to
/// `diagnostics`.
Factor makeFactor(const std::string& name, const std::vector<std::string>& values, const Scene& scene,
                  const std::string& folder, const SourceLocation& where, Diagnostics& diagnostics);

/// The factors worth varying in this scene.
std::vector<Factor> defaultFactors(const Loaded& base, const std::string& folder, bool quick);

/// E816: a named factor does nothing in this scene; the help names those that do something.
void checkUse(const Factor& factor, const Loaded& base, const SourceLocation& where, Diagnostics& diagnostics);

/// True when the scene has dynamics, with any engine.
bool hasMotion(const Plan& plan);

/// Which values of a factor, given by name or by path, are more accurate.
Direction directionOf(const std::string& factor, const Scene& scene);

/// Names of all named factors.
std::vector<std::string> factorNames();

/// kGrid: every combination of the factors' values; kOneAtATime: each value alone.
enum class Combine { kGrid, kOneAtATime };

/// Adds settings to the study: first the unmodified scene, then every other setting once. A value that the scene
/// rejects is an error; a rejected combination of valid values is an impossible setting.
void addSettings(Study& study, const std::vector<Factor>& factors, Combine combine, Diagnostics& diagnostics);
/// Loads and checks the scene with these sets; returns a hash of all its values and of the meshes that it names; those
/// that the study makes in its own `folder` count by their names alone. Errors go to `diagnostics`.
std::uint64_t checkedScene(const Inputs& inputs, const std::vector<std::string>& sets, const std::string& folder,
                           Diagnostics& diagnostics);
/// Fills Setting::name and Setting::choices. Call it after all settings have been added.
void nameSettings(Study& study);

}  // namespace presa::cost
