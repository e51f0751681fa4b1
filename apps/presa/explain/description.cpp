#include "apps/presa/explain/description.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "apps/common/grasp_loop.h"
#include "framework/core/schedule/rates.h"
#include "framework/geometry/model.h"
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

template <class... Values>
std::string formatted(const char* format, Values... values) {
  std::array<char, 160> text;
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

std::string byButton(const Frame::Button& button) {
  return button.number ? formatted("button %d or the window's key", *button.number) : "the window's key";
}

/// What its user may do with a frame: "in user; clutch by button 1 or the window's key; scale 0.5 to 2, …".
std::string describeFrame(const Frame& frame) {
  std::string text = "in " + frame.parent;
  if (frame.moves != Frame::Moves::kNot)
    text += formatted("; %s at up to %.4g m/s and turns at up to %.4g deg/s, by the window's keys",
                      frame.moves == Frame::Moves::kWalk ? "walks" : "flies", frame.speed,
                      frame.turn * 180 / std::numbers::pi);
  if (!frame.drift.isZero()) text += formatted("; moves by itself at %.4g m/s", frame.drift.norm());
  if (frame.clutch) text += "; clutch by " + byButton(*frame.clutch);
  if (frame.zoom)
    text += formatted("; scale %.4g to %.4g, finer by ", frame.zoom->min, frame.zoom->max) + byButton(frame.zoom->in) +
            ", coarser by " + byButton(frame.zoom->out);
  return text + "; rests while a finger in it feels a force";
}

/// What a view draws of a mesh file beside its triangles.
std::string describeModel(const Model& model) {
  std::string text =
      std::filesystem::path(model.file).filename().string() + formatted(", %zu triangles, ", model.triangles());
  if (model.textures.empty()) text += "colours without textures";
  for (std::size_t n = 0; n < model.textures.size(); ++n) {
    const ModelTexture& texture = model.textures[n];
    text += (n == 0 ? "textures " : ", ") + texture.name + formatted(" of %d x %d", texture.width, texture.height);
  }
  return text + "; a view makes coarser levels of detail, a quarter of the triangles each";
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
  for (const Frame& frame : session.world()->rig.frames)
    if (frame.driven()) out["frames"].push_back({{"name", frame.name}, {"what", describeFrame(frame)}});
  for (std::size_t b = 0; b < session.world()->meshes.size(); ++b)
    if (const auto& model = session.world()->meshes[b].model)
      out["models"].push_back({{"body", session.world()->scene.bodies[b].name}, {"what", describeModel(*model)}});
  describeGrasps(*session.world(), out);
  for (const std::string& library : mappedLibraries()) {
    out["libraries"].push_back({{"name", library},
                                {"plugin", library.starts_with("presa_")},
                                {"needed_by", before.contains(library) ? "the program" : "the scene"}});
  }
  return out;
}

}  // namespace presa
