#include "apps/presa/explain/grasp.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "apps/common/exit_status.h"
#include "apps/common/summary.h"
#include "apps/common/terminal/text.h"
#include "apps/common/terminal_run.h"
#include "framework/core/diagnostics/printable.h"

namespace presa {
namespace {

using terminal::format;

constexpr double kGraspTraceRate = 250;  // as `presa run`

/// End of the scripted hold of the first device [s]; 0: it has none.
double holdEnd(const Loaded& loaded) {
  if (loaded.devices.empty()) return 0;
  const Device& device = *loaded.devices.front();
  const auto hold = firstSpanOf(PhaseIntent::kHold, device.phaseIntents(), device.phaseTimes());
  return hold ? hold->end : 0;
}

/// "0.491", or "0.49 to 0.52" where the bounds do not meet.
std::string between(const ProvenBounds& bounds, const char* number) {
  std::array<char, 40> low, high;
  std::snprintf(low.data(), low.size(), number, bounds.at_least);
  std::snprintf(high.data(), high.size(), number, bounds.at_most);
  return bounds.met() ? low.data() : std::string(low.data()) + " to " + high.data();
}

std::string closureWords(const GraspQuality& quality) {
  switch (quality.closure) {
    case GraspClosure::kFull:
      return "full: the fingers resist every push and every turn, if they press hard enough";
    case GraspClosure::kPartial:
      return format("partial: of the body's six motions, %d %s not opposed however hard the fingers press",
                    quality.unopposed, quality.unopposed == 1 ? "is" : "are");
    case GraspClosure::kNone:
      break;
  }
  return "none: the fingers push the body to one side";
}

std::string qualityWords(const GraspQuality& quality) {
  std::string words = quality.closure == GraspClosure::kFull ? between(quality.epsilon, "%.3g") : "0";
  if (quality.closure == GraspClosure::kPartial)
    words += ", but " + between(quality.within_span, "%.3g") + " for all motions that are opposed";
  return words;
}

std::string qualityUnit(const GraspStrength& strength) {
  return format("(push [N], or turn [N times %.3g mm], that is resisted in every direction with 1 N of grip in all)",
                1000 * strength.grasp.length);
}

std::string marginWords(const GraspStrength& strength) {
  const ProvenBounds& margin = strength.slip_margin;
  if (std::isinf(margin.at_least)) return "there is no weight";
  if (!(margin.at_most > 0)) return "0: this grasp does not hold the weight, however hard it is";
  const std::string held = between(margin, "%.3g") + format(" times the weight of %.4g N", strength.weight);
  return held + (margin.at_most < 1 ? " is all that this grip holds" : " before a finger slips, none pressing harder");
}

std::string minGripWords(const GraspStrength& strength) {
  if (std::isinf(strength.min_grip.at_most)) return "no grip holds the weight with these contacts";
  return format("%.4g N of normal force on each finger holds the weight", strength.min_grip.at_most);
}

std::string heading(const RunResult& result, const GraspStrength& strength) {
  std::string names;
  for (const std::size_t finger : strength.contact_points)
    names += (names.empty() ? "" : " and ") + result.contact_points[finger].name;
  return names + format(", at %.3f s", strength.time);
}

void printLines(const std::string& text) { std::fputs(printableLines(text).c_str(), stdout); }

int printGrasp(const RunResult& result, bool as_json) {
  const std::optional<GraspFigures> figures = graspFigures(result);
  if (as_json) {
    const auto summary = nlohmann::ordered_json::parse(summaryJson(result));
    printLines((summary.contains("grasp") ? summary["grasp"] : nlohmann::ordered_json()).dump(2) + "\n");
  } else if (!figures) {
    printLines("Scene " + result.world->scene.name + ": no grasp, nothing was held by two fingers during the hold.\n");
  } else if (const auto strength = graspStrength(result, *figures)) {
    printLines("Scene " + result.world->scene.name + ": " + result.objects[figures->object].name + " held by " +
               graspText(result, *strength));
  } else {
    printLines("Scene " + result.world->scene.name + ": no friction cone to judge the grasp of " +
               result.objects[figures->object].name + " by.\n");
  }
  for (const RunResult::Fault& fault : result.faults)
    std::fputs(printableLines(format("%.3f s: ", fault.time) + fault.text + "\n").c_str(), stderr);
  if (result.interrupted) return kExitInterrupted;
  return result.faults.empty() ? kExitOk : kExitFault;
}

}  // namespace

std::string graspText(const RunResult& result, const GraspStrength& strength) {
  std::string out = heading(result, strength) + "\n\n";
  out += format("  %-14s %10s %10s %16s\n", "finger", "normal N", "friction", "friction used");
  for (std::size_t i = 0; i < strength.contact_points.size(); ++i) {
    const GraspContact& contact = strength.grasp.contacts[i];
    out += format("  %-14s %10.3f %10.2f %14.0f %%\n", result.contact_points[strength.contact_points[i]].name.c_str(),
                  contact.max_normal, contact.friction, 100 * strength.friction_used[i]);
  }
  const auto row = [&](const char* name, const std::string& words) { out += format("  %-16s ", name) + words + '\n'; };
  out += '\n';
  row("force closure", closureWords(strength.quality));
  row("weakest", strength.weakest + (strength.quality.closure == GraspClosure::kFull ? "" : ": nothing opposes it"));
  row("quality", qualityWords(strength.quality));
  row("", qualityUnit(strength));
  row("slip margin", marginWords(strength));
  row("min grip", minGripWords(strength));
  return out;
}

int explainGrasp(Loaded loaded, bool as_json) {
  const double end = holdEnd(loaded);
  if (!(end > 0)) {
    Diagnostics diagnostics;
    diagnostics.error(125, {loaded.world->scene.file, 0, 0},
                      "--grasp needs a device with a scripted phase whose intent is hold, found none",
                      "say <phase … intent=\"hold\"> in its motion, or name a rig whose motion does: --rig "
                      "config/rigs/pinch_cube.xml");
    std::fputs(diagnostics.text().c_str(), stderr);
    return kExitBadInput;
  }
  loaded.options.duration = end;
  TerminalRun run(std::move(loaded), {.trace_rate = kGraspTraceRate, .quiet = true, .command = ""});
  run.execute();
  return printGrasp(run.result(), as_json);
}

}  // namespace presa
