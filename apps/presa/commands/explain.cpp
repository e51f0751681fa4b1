#include <cstdio>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "apps/presa/commands/commands.h"
#include "framework/plan/load_world.h"
#include "framework/plan/session.h"

namespace presa {
namespace {

struct Arguments {
  Inputs inputs;
  std::string format = "text";
};

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

// Shared objects mapped into this process, by file name.
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

std::string reasonOf(const Plan& plan, const std::string& module) {
  for (const PlannedModule& planned : plan.modules) {
    if (planned.plugin == module) return planned.reason;
  }
  if (module == "device_input" || module == "device_output") return "the scene has devices";
  return "every run is observed";
}

nlohmann::json describeRun(const Loaded& loaded, Session& session) {
  const RateTable rates(loaded.world->scene.rates);
  nlohmann::json out;
  out["scene"] = loaded.world->scene.name;
  for (const char* key : {"modules", "threads", "connections", "stages", "devices", "left_out"})
    out[key] = nlohmann::json::array();
  for (int g = 0; g < kRateGroupCount; ++g) {
    const auto group = static_cast<RateGroup>(g);
    if (!session.graph().runs(group)) {
      out["left_out"].push_back(
          {{"what", std::string(toString(group)) + " thread"}, {"why", "no module runs at its rate"}});
      continue;
    }
    out["threads"].push_back(
        {{"name", toString(group)}, {"rate_hz", rates.rate(group)}, {"period_s", rates.period(group)}});
    for (const Module* module : session.graph().modules(group)) {
      out["modules"].push_back(
          {{"name", module->name()}, {"group", toString(group)}, {"reason", reasonOf(loaded.plan, module->name())}});
      for (const std::string& stage : module->stages()) {
        out["stages"].push_back({{"group", toString(group)}, {"module", module->name()}, {"stage", stage}});
      }
    }
  }
  for (const Connection& connection : session.graph().connections()) {
    nlohmann::json c = {{"from", connection.from->owner().name()},
                        {"to", connection.to->owner().name()},
                        {"value", connection.to->name()},
                        {"across_rates", connection.bridge != nullptr}};
    if (connection.bridge != nullptr && std::isfinite(connection.to->oldAfter())) {
      c["when_old"] = describe(connection.to->whenOld());
      c["old_after_s"] = connection.to->oldAfter();
    }
    out["connections"].push_back(c);
  }
  for (const PlannedDevice& device : loaded.plan.devices)
    out["devices"].push_back({{"role", device.role}, {"driver", device.driver}});
  for (const LeftOut& left_out : loaded.plan.left_out)
    out["left_out"].push_back({{"what", left_out.what}, {"why", left_out.why}});
  out["libraries"] = mappedLibraries();
  return out;
}

void printText(const nlohmann::json& run) {
  const auto text = [](const nlohmann::json& value) { return value.get<std::string>(); };
  std::printf("scene %s\n\nthreads and what runs on them, in order\n", text(run["scene"]).c_str());
  for (const auto& thread : run["threads"]) {
    std::printf("  %-10s %6.0f Hz\n", text(thread["name"]).c_str(), thread["rate_hz"].get<double>());
    for (const auto& module : run["modules"]) {
      if (module["group"] != thread["name"]) continue;
      std::printf("    %-15s because %s\n", text(module["name"]).c_str(), text(module["reason"]).c_str());
      for (const auto& stage : run["stages"]) {
        if (stage["module"] == module["name"]) std::printf("        - %s\n", text(stage["stage"]).c_str());
      }
    }
  }
  std::printf("\ndevices\n");
  for (const auto& device : run["devices"]) {
    std::printf("  %-10s played by driver %s\n", text(device["role"]).c_str(), text(device["driver"]).c_str());
  }
  std::printf("\nvalues that cross threads\n");
  for (const auto& c : run["connections"]) {
    if (!c["across_rates"].get<bool>()) continue;
    std::printf("  %-16s %s -> %s", text(c["value"]).c_str(), text(c["from"]).c_str(), text(c["to"]).c_str());
    if (c.contains("when_old"))
      std::printf("  (older than %.0f ms: %s)", c["old_after_s"].get<double>() * 1e3, text(c["when_old"]).c_str());
    std::printf("\n");
  }
  std::printf("\nleft out\n");
  for (const auto& left_out : run["left_out"])
    std::printf("  %-16s %s\n", text(left_out["what"]).c_str(), text(left_out["why"]).c_str());
  std::printf("\nlibraries mapped (%zu)\n ", run["libraries"].size());
  std::size_t column = 1;
  for (const auto& library : run["libraries"]) {
    const std::string name = text(library);
    if (column + name.size() > 98) {
      std::printf("\n ");
      column = 1;
    }
    std::printf(" %s", name.c_str());
    column += name.size() + 1;
  }
  std::printf("\n");
}

void printDot(const nlohmann::json& run) {
  std::printf("digraph \"%s\" {\n  rankdir=LR; node [shape=box, style=rounded, fontname=\"sans\"];\n",
              run["scene"].get<std::string>().c_str());
  for (const auto& thread : run["threads"]) {
    std::printf("  subgraph cluster_%s { label=\"%s %.0f Hz\";", thread["name"].get<std::string>().c_str(),
                thread["name"].get<std::string>().c_str(), thread["rate_hz"].get<double>());
    for (const auto& module : run["modules"]) {
      if (module["group"] == thread["name"]) std::printf(" %s;", module["name"].get<std::string>().c_str());
    }
    std::printf(" }\n");
  }
  for (const auto& c : run["connections"]) {
    std::printf("  %s -> %s [label=\"%s\"%s];\n", c["from"].get<std::string>().c_str(),
                c["to"].get<std::string>().c_str(), c["value"].get<std::string>().c_str(),
                c["across_rates"].get<bool>() ? ", style=dashed" : "");
  }
  std::printf("}\n");
}

int explain(const Arguments& arguments) {
  Diagnostics diagnostics;
  const Loaded loaded = loadWorld(arguments.inputs, {}, diagnostics);
  std::fputs(diagnostics.text().c_str(), stderr);
  if (diagnostics.hasErrors()) return kExitBadInput;
  RunControl control;
  Session::Options options;
  options.open_devices = false;
  Session session(loaded.world, loaded.plan, control, std::move(options));
  const nlohmann::json run = describeRun(loaded, session);
  if (arguments.format == "json") {
    std::printf("%s\n", run.dump(2).c_str());
  } else if (arguments.format == "dot") {
    printDot(run);
  } else {
    printText(run);
  }
  return kExitOk;
}

}  // namespace

void addExplain(CLI::App& app, int& status) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("explain", "Say which parts a scene calls for, why, and what is left out");
  command->add_option("SCENE", arguments->inputs.scene, "scene file")->required();
  command->add_option("--rig", arguments->inputs.rig, "rig file instead of the scene's own");
  command->add_option("--set", arguments->inputs.sets, "PATH=VALUE; may be repeated");
  command->add_option("--format", arguments->format, "text, json or dot (for graphviz)")
      ->check(CLI::IsMember({"text", "json", "dot"}));
  command->footer("Example:  presa explain config/scenes/cube.xml --format dot | dot -Tsvg > cube.svg");
  command->callback([arguments, &status] { status = explain(*arguments); });
}

}  // namespace presa
