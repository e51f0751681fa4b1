#include "apps/studies/cost/fixed_rig.h"

#include "apps/common/report/svg_plot.h"

namespace presa::cost {

std::string rigWithFixedDamping(const Loaded& base) {
  if (base.plan.devices.empty()) return {};
  const auto quoted = [](const std::string& value) { return "\"" + svg::escape(value) + "\""; };
  std::string out =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<rig version=\"1.0\" name=" + quoted(base.world->rig.name) + ">\n";
  for (const DeviceBinding& binding : base.world->rig.devices) {
    out += "  <device role=" + quoted(binding.role) + " driver=" + quoted(binding.driver) + ">\n";
    for (const auto& [key, setting] : binding.settings)
      out += "    <set key=" + quoted(key) + " value=" + quoted(setting.value) + "/>\n";
    for (std::size_t i = 0; i < base.devices.size(); ++i) {
      const bool fixed = binding.settings.contains("damping") || binding.driver != "scripted";
      if (base.plan.devices[i].role != binding.role || fixed) continue;
      out += "    <set key=\"damping\" value=" + quoted(std::to_string(base.devices[i]->damping())) + "/>\n";
    }
    out += "  </device>\n";
  }
  return out + "</rig>\n";
}

}  // namespace presa::cost
