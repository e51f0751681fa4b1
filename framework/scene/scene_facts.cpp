#include "framework/scene/scene_facts.h"

#include <algorithm>

namespace presa {
namespace {

/// The haptic tick tests up to this many bodies faster than it reads a list of near ones.
constexpr std::size_t kFewTouchables = 32;
constexpr const char* kPrimitives =
    "few haptic geometries, and all of them primitives, which the haptic tick handles exactly";

struct AskedRun {
  const Scene& scene;
  const Rig& rig;
  const RunOptions& options;
};

bool isTouchable(const Body& body) { return body.haptic.has_value(); }
bool isTouchableMesh(const Body& body) { return body.haptic && std::holds_alternative<MeshRef>(body.haptic->shape); }
bool isFree(const Body& body) { return !body.fixed; }

/// "body 'cube' <says>" of the first such body; a fact that does not hold, for the reason `otherwise`, without one.
SceneFact aboutBody(const Scene& scene, bool (*is_such)(const Body&), const std::string& says, const char* otherwise) {
  const auto found = std::ranges::find_if(scene.bodies, is_such);
  if (found == scene.bodies.end()) return {"", false, otherwise};
  return {"", true, "body '" + found->name + "' " + says};
}

SceneFact fingers(const AskedRun& run) {
  if (run.scene.devices.empty()) return {"", false, "the scene has no device"};
  const auto touchable = std::ranges::find_if(run.scene.bodies, isTouchable);
  if (touchable == run.scene.bodies.end()) return {"", true, "the scene has devices"};
  return {"", true, "fingers can touch body '" + touchable->name + "'"};
}

SceneFact fingertips(const AskedRun& run) {
  if (run.scene.devices.empty()) return {"", false, "the scene has no device"};
  if (!run.scene.hasFingertips()) return {"", false, "every device holds a tool"};
  return {"", true, "a device moves a fingertip"};
}

SceneFact touchableMesh(const AskedRun& run) {
  return aboutBody(run.scene, isTouchableMesh, "has a mesh as haptic geometry", kPrimitives);
}

SceneFact manyTouchables(const AskedRun& run) {
  const auto count = static_cast<std::size_t>(std::ranges::count_if(run.scene.bodies, isTouchable));
  if (count <= kFewTouchables) return {"", false, kPrimitives};
  return {"", true, std::to_string(count) + " bodies can be touched"};
}

SceneFact freeBody(const AskedRun& run) { return aboutBody(run.scene, isFree, "is free", "every body is fixed"); }

SceneFact assembly(const AskedRun& run) {
  if (!run.scene.assembly) return {"", false, "the scene has no assembly"};
  return {"", true, "bodies are to be put together"};
}

SceneFact hapticRate(const AskedRun& run) {
  const bool is = run.scene.dynamics.coupling == DynamicsSettings::Coupling::kHapticRate;
  const std::string& reason = run.scene.dynamics.coupling_reason;
  if (!reason.empty()) return {"", true, reason};
  return {"", is, is ? "<dynamics coupling=\"haptic_rate\">" : "the scene's coupling is not 'haptic_rate'"};
}

SceneFact recording(const AskedRun& run) {
  if (!run.options.record.empty()) return {"", true, "the run is recorded"};
  if (!run.options.flight.empty()) return {"", true, "the last two seconds are kept for a fault"};
  return {"", false, "nothing is recorded"};
}

SceneFact view(const AskedRun& run) {
  using View = RunOptions::View;
  if (run.options.view == View::kNone) return {"", false, "no view is wanted"};
  return {"", true, run.options.view == View::kWindow ? "--view window" : "a picture is wanted"};
}

SceneFact bus(const AskedRun& run) {
  const std::optional<BusSettings> bus = busOf(run.scene, run.rig, run.options);
  if (!bus) return {"", false, "no bus was requested (--bus)"};
  if (run.options.bus) return {"", true, "--bus " + bus->network};
  const std::string who = run.rig.bus ? "the rig '" + run.rig.name : "the scene '" + run.scene.name;
  return {"", true, who + "' publishes on bus '" + bus->network + "'"};
}

struct FactRule {
  const char* name;
  SceneFact (*of)(const AskedRun&);
};

constexpr FactRule kRules[] = {{"fingers", fingers},
                               {"fingertips", fingertips},
                               {"touchable_mesh", touchableMesh},
                               {"many_touchables", manyTouchables},
                               {"free_body", freeBody},
                               {"haptic_rate", hapticRate},
                               {"assembly", assembly},
                               {"recording", recording},
                               {"view", view},
                               {"bus", bus}};

}  // namespace

std::vector<SceneFact> factsOf(const Scene& scene, const Rig& rig, const RunOptions& options) {
  const AskedRun run{scene, rig, options};
  std::vector<SceneFact> facts;
  for (const FactRule& rule : kRules) {
    facts.push_back(rule.of(run));
    facts.back().name = rule.name;
  }
  return facts;
}

const std::vector<std::string>& factNames() {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> names;
    for (const FactRule& rule : kRules) names.emplace_back(rule.name);
    return names;
  }();
  return kNames;
}

}  // namespace presa
