#include "apps/presa/explain/description.h"

#include <cmath>
#include <fstream>

#include "apps/common/grasp_loop.h"
#include "framework/core/schedule/rates.h"
#include "framework/scene/decompositions.h"
#include "framework/scene/joints/joint_words.h"

namespace presa {
namespace {

using nlohmann::json;

const char* describe(WhenOld when_old) {
  switch (when_old) {
    case WhenOld::kHold:
      return "hold";
    case WhenOld::kExtrapolate:
      return "extrapolate";
    case WhenOld::kFadeToZero:
      return "fade to zero";
  }
  return "?";
}

std::string reasonOf(const Plan& plan, const std::string& module) {
  for (const PlannedModule& planned : plan.modules) {
    if (planned.plugin == module) return planned.reason;
  }
  if (module == "device_input" || module == "device_output") return "the scene has devices";
  return "every run is observed";
}

void describeModule(const Module& module, const Plan& plan, json& out) {
  const char* group = toString(module.group());
  out["modules"].push_back({{"name", module.name()}, {"group", group}, {"reason", reasonOf(plan, module.name())}});
  for (const std::string& stage : module.stages())
    out["stages"].push_back({{"group", group}, {"module", module.name()}, {"stage", stage}});
  for (const LeftOut& left_out : module.leftOut()) {
    out["left_out"].push_back({{"what", left_out.what}, {"why", left_out.why}});
  }
}

json describe(const Connection& connection) {
  json out = {{"from", connection.from->owner().name()},
              {"to", connection.to->owner().name()},
              {"value", connection.to->name()},
              {"across_rates", connection.bridge != nullptr}};
  if (connection.bridge != nullptr && std::isfinite(connection.to->oldAfter())) {
    out["when_old"] = describe(connection.to->whenOld());
    out["old_after_s"] = connection.to->oldAfter();
  }
  return out;
}

void describeGrasps(const World& world, json& out) {
  for (const GraspLoop& loop : graspLoops(world)) {
    out["grasps"].push_back({{"body", world.scene.bodies[loop.body].name},
                             {"fingers", loop.fingers},
                             {"stiffness_N_m", loop.stiffness},
                             {"mass_kg", loop.mass},
                             {"natural_frequency_hz", loop.naturalFrequency()},
                             {"explicit_min_mass_kg", loop.explicitMinMass(1 / world.scene.rates.dynamics)}});
  }
}

}  // namespace

std::set<std::string> mappedLibraries() {
  std::set<std::string> libraries;
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    const std::size_t slash = line.rfind('/');
    if (slash != std::string::npos && line.find(".so", slash) != std::string::npos)
      libraries.insert(line.substr(slash + 1));
  }
  return libraries;
}

json describeSession(Session& session, const std::set<std::string>& before) {
  const RateTable rates(session.world()->scene.rates);
  json out;
  out["scene"] = session.world()->scene.name;
  for (const char* key :
       {"threads", "modules", "stages", "connections", "effects", "devices", "left_out", "libraries", "decomposed"})
    out[key] = json::array();
  for (const LeftOut& left_out : session.plan().left_out)
    out["left_out"].push_back({{"what", left_out.what}, {"why", left_out.why}});
  for (int g = 0; g < kRateGroupCount; ++g) {
    const auto group = static_cast<RateGroup>(g);
    if (!session.graph().runs(group)) {
      out["left_out"].push_back(
          {{"what", std::string(toString(group)) + " thread"}, {"why", "no module runs at its rate"}});
      continue;
    }
    out["threads"].push_back(
        {{"name", toString(group)}, {"rate_hz", rates.rate(group)}, {"period_s", rates.period(group)}});
    for (const Module* module : session.graph().modules(group)) describeModule(*module, session.plan(), out);
  }
  for (const Connection& connection : session.graph().connections()) out["connections"].push_back(describe(connection));
  for (const PlannedEffect& effect : session.plan().effects)
    out["effects"].push_back({{"plugin", effect.plugin}, {"reason", effect.reason}});
  for (const PlannedDevice& device : session.plan().devices)
    out["devices"].push_back({{"role", device.role}, {"driver", device.driver}, {"frames", device.frames}});
  for (const DecomposedMesh& mesh : decompositionsOf(*session.world())) out["decomposed"].push_back(textOf(mesh));
  for (const Joint& joint : session.world()->scene.joints)
    out["joints"].push_back({{"name", joint.name}, {"what", describeJoint(session.world()->scene, joint)}});
  describeGrasps(*session.world(), out);
  for (const std::string& library : mappedLibraries()) {
    out["libraries"].push_back({{"name", library},
                                {"plugin", library.starts_with("presa_")},
                                {"needed_by", before.contains(library) ? "the program" : "the scene"}});
  }
  return out;
}

}  // namespace presa
