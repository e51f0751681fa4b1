#include "apps/presa/replay_page/replay_page.h"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/common/number_text.h"
#include "apps/common/output_place.h"
#include "apps/common/report/fault_events.h"
#include "apps/common/report/joint_section.h"
#include "apps/common/report/recording_page.h"
#include "apps/presa/replay_page/figures.h"
#include "apps/presa/replay_page/keyframes.h"
#include "apps/presa/replay_page/resources.h"
#include "apps/presa/replay_page/shapes.h"
#include "apps/presa/replay_page/signals.h"
#include "framework/core/diagnostics/refuse.h"
#include "framework/session/load_world.h"
#include "framework/session/session.h"

namespace presa::replay_page {
namespace {

using nlohmann::json;

constexpr double kTicksApart = 20;  // without a tick for longer, the loop stood still

struct Scenery {
  std::shared_ptr<const World> world;  ///< null: the scene cannot be loaded again
  std::string trouble;                 ///< why not
  std::vector<std::string> phases;     ///< names, for a recording without them
};

/// Names of the phases from the drivers of the rig; none when they or their scripts are not here any more.
std::vector<std::string> phaseNames(const Loaded& loaded) {
  Diagnostics ignored;
  try {
    for (const auto& device : createDevices(loaded.world, loaded.options, loaded.plan, ignored))
      if (!device->phases().empty()) return device->phases();
  } catch (const InputError&) {
  }
  return {};
}

Scenery sceneryOf(const Recording& recording) {
  RunOptions options;
  options.bus = BusSettings{.network = "none"};
  Diagnostics diagnostics;
  const Loaded loaded =
      loadWithoutDevices({recording.scene_xml, recording.scene_file, recording.rig_xml}, options, diagnostics);
  if (diagnostics.hasErrors()) {
    for (const Diagnostic& finding : diagnostics.all())
      if (finding.severity == Diagnostic::Severity::kError) return {nullptr, finding.message, {}};
  }
  return {loaded.world, "", phaseNames(loaded)};
}

json faultsOf(const RecordedSamples& samples) {
  json faults = json::array();
  for (const svg::Event& event : faultEvents(samples.faults))
    faults.push_back({{"time", event.time}, {"text", event.label}});
  return faults;
}

std::string milliseconds(double seconds) { return significant(1000 * seconds, 3) + " ms"; }

/// What was left out, in a sentence.
std::string decimationOf(const json& signals, const json& motion, std::size_t triangles, const World* world) {
  std::string text = signals["every_tick"].get<bool>()
                         ? "Plots: every haptic tick. "
                         : "Plots: min and max of every " + milliseconds(signals["width"]) + ". ";
  if (world == nullptr) return text;
  text += "Picture: a pose every " + milliseconds(motion["period"]) + " (" +
          significant(1 / motion["period"].get<double>(), 3) + " Hz), straight between them";
  if (triangles > kMaxTriangles) text += "; meshes simplified to " + std::to_string(kMaxTriangles) + " triangles";
  if (world->scene.bodies.size() > kMaxBodies)
    text +=
        "; the first " + std::to_string(kMaxBodies) + " of " + std::to_string(world->scene.bodies.size()) + " bodies";
  return text + ". Forces: 10 mm of arrow per newton.";
}

std::size_t trianglesOf(const World& world) {
  std::size_t all = 0;
  for (const BodyMeshes& meshes : world.meshes) {
    if (const TriMesh* mesh = (meshes.visual ? meshes.visual : meshes.haptic).get()) all += mesh->triangles.size();
  }
  return all;
}

json dataOf(const Recording& recording, const RecordedSamples& samples, const Scenery& scenery) {
  const World* world = scenery.world.get();
  json data{{"signals", signalsOf(samples, world, recording.surfaces_changed)},
            {"phases", phasesOf(samples, scenery.phases)},
            {"faults", faultsOf(samples)},
            {"begin", samples.time.front()},
            {"end", samples.time.back()},
            {"trouble", scenery.trouble}};
  if (world != nullptr) {
    const PageFigures figures = figuresOf(world->rig, samples);
    data["scene"] = shapesOf(*world, figures);
    data["motion"] = keyframesOf(samples, *world, figures);
  }
  const json none{{"period", 1.0}};
  data["decimation"] = decimationOf(data["signals"], world != nullptr ? data["motion"] : none,
                                    world != nullptr ? trianglesOf(*world) : 0, world);
  if (!recording.commands.empty())
    data["decimation"] = data["decimation"].get<std::string>() +
                         " Commands changed surfaces during the run; the friction limit is that of the scene.";
  return data;
}

std::string jointsOf(const RecordedSamples& samples, const Scenery& scenery) {
  if (scenery.world == nullptr || scenery.world->scene.joints.empty()) return {};
  const JointLog log = jointLogOf(samples, scenery.world->scene);
  return html::jointSection(&log, kTicksApart * samples.haptic_period);
}

/// No text of a recording ends the data block.
std::string blockOf(const json& data) {
  std::string text = data.dump(-1, ' ', false, json::error_handler_t::replace), safe;
  safe.reserve(text.size());
  for (const char c : text) c == '<' ? safe += "\\u003c" : safe += c;
  return "<script type=\"application/json\" id=\"replay-data\">" + safe + "</script>\n";
}

}  // namespace

void checkPlace(const std::string& page) {
  const std::string trouble = placeTrouble(page);
  if (!trouble.empty()) refuse(126, "--page " + page, "the page cannot be written there", trouble);
}

std::string page(const Recording& recording, const RecordedSamples& samples, const std::string& three_js) {
  const Scenery scenery = sceneryOf(recording);
  std::string style, markup, scripts;
  for (const File& file : files()) {
    const std::string path = file.path;
    if (path.ends_with(".css")) style += file.text;
    if (path.ends_with(".html")) markup += file.text;
    if (path.ends_with(".js")) scripts += std::string("<script>\n") + file.text + "</script>\n";
  }
  const std::string data = blockOf(dataOf(recording, samples, scenery));
  const bool drawn = scenery.world != nullptr;
  return recordingPage(recording.file, samples, bodyNames(recording.scene_xml),
                       {style, markup + data + (drawn ? three_js : "") + scripts, jointsOf(samples, scenery)});
}

}  // namespace presa::replay_page
