#include "apps/studies/cost/identity.h"

#include "apps/common/file_text.h"
#include "apps/common/version.h"
#include "apps/studies/cost/factors.h"
#include "apps/studies/cost/fixed_rig.h"
#include "apps/studies/cost/hash.h"
#include "apps/studies/cost/reference_levels.h"
#include "apps/studies/cost/trace.h"

namespace presa::cost {

Identity identityOf(const Study& study) {
  Identity identity;
  Diagnostics diagnostics;
  const Loaded base = loadWorld(study.inputs, {}, diagnostics);
  if (!diagnostics.hasErrors()) {
    for (std::size_t level = 0; level < study.reference.size(); ++level)
      identity.levels.push_back(
          checkedScene(study.inputs, setsOfLevel(study, level, noLimits(study)), study.folder, diagnostics));
  }
  if (diagnostics.hasErrors()) throw InputError(diagnostics);
  identity.rig = rigWithFixedDamping(base);
  Hash common;
  common.add(identity.rig);
  for (const DeviceBinding& binding : base.world->rig.devices) {
    for (const auto& [key, setting] : binding.settings) {
      if (key == "motion" || key == "file") common.add(contentsOf(setting.value));
    }
  }
  for (const std::string& text :
       {std::to_string(study.duration), std::to_string(study.seed), study.compared.from, study.compared.to,
        study.steady.from, study.steady.to, versionText(), std::string(Trace::kFormat)})
    common.add(text);
  identity.common = common.value();
  for (const Setting& setting : study.settings) {
    common.add(setting.name);
    common.add(setting.impossible.empty() ? std::to_string(setting.scene_hash) : "impossible");
  }
  for (const std::uint64_t level : identity.levels) common.add(std::to_string(level));
  for (const std::string& metric : study.metrics) common.add(metric);
  common.add(std::to_string(study.repeats));
  identity.study = common.value();
  return identity;
}

}  // namespace presa::cost
