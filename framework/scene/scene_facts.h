#pragma once
#include <string>
#include <vector>

#include "framework/scene/run_options.h"
#include "framework/scene/scene.h"

namespace presa {

/// One thing that a scene or its run calls for, in the word that manifests of modules use:
/// `<wanted when="fingers touchable_mesh"/>`.
struct SceneFact {
  std::string name;    ///< "free_body"
  bool holds = false;  ///< in this run
  std::string why;     ///< why it holds, or why it does not: "body 'cube' is free", "every body is fixed"
};

/// All facts of a run, in the order of factNames(). Thread: any.
std::vector<SceneFact> factsOf(const Scene& scene, const Rig& rig, const RunOptions& options);

/// The words that a manifest may use. Thread: any.
const std::vector<std::string>& factNames();

}  // namespace presa
