#pragma once
#include <string>
#include <vector>

#include "apps/studies/cost/study.h"

namespace presa::cost {

/// A knob by name or by path, with the values from the command line or a study file. `folder` is where decimated meshes
/// go, `where` names the knob in messages. Findings (E801 unknown name, E802 no usable value) go to `diagnostics`.
Knob makeKnob(const std::string& name, const std::vector<std::string>& values, const Scene& scene,
              const std::string& folder, const SourceLocation& where, Diagnostics& diagnostics);

/// What is worth varying in this scene, one knob at a time.
std::vector<Knob> defaultKnobs(const Loaded& base, const std::string& folder, bool quick);

/// Whether the scene has dynamics, by whatever engine.
bool hasMotion(const Plan& plan);

/// Names of all knobs that are no paths.
std::vector<std::string> knobNames();

/// Every combination of the knobs' values, or each value alone.
enum class Combine { kGrid, kOneAtATime };

/// Adds settings to the study: the scene as it stands first, each other once. A value that the scene does not take is a
/// finding; a combination that it does not take is an impossible setting.
void addSettings(Study& study, const std::vector<Knob>& knobs, Combine combine, Diagnostics& diagnostics);
/// The scene with these sets, checked: a hash of all its values, findings to `diagnostics`.
std::uint64_t checkedScene(const Inputs& inputs, const std::vector<std::string>& sets, Diagnostics& diagnostics);
/// Fills Setting::name and Setting::choices when all are there.
void nameSettings(Study& study);

}  // namespace presa::cost
