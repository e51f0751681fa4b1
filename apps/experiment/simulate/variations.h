#pragma once
#include <string>
#include <vector>

#include "apps/experiment/simulate/studies.h"
#include "experiments/runner/definition/definition.h"

/// What single properties of the devices do to the results of an experiment: its studies are simulated again with
/// other settings of the rig.
namespace presa::experiment {

/// The studies with one setting of every device, or as the rig has it.
struct Variation {
  std::string key, value;  ///< both empty: as the rig has it
  StudiesPlan plan;        ///< in a folder of its own, with a rig of its own

  std::string name() const { return key.empty() ? "as the rig has it" : key + "=" + value; }
};

/// The rig as it is, then each of `settings` ("KEY=VALUE"). E954: not of this form.
std::vector<Variation> variationsOf(const StudiesPlan& plan, const std::vector<std::string>& settings);

/// The rig with the variation's setting in every device, in place of one that it has.
std::string rigWith(const std::string& rig_xml, const Variation& variation);

/// Analyses the studies of all variations and writes OUT/variations.csv (every number) and OUT/variations.html: the
/// correlations of each variation and their difference from the rig as it is, which also go to stdout. Returns an exit
/// status.
int reportVariations(const std::string& out, const std::vector<Variation>& variations, const Experiment& experiment);

}  // namespace presa::experiment
