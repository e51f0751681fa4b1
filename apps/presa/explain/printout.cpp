#include "apps/presa/explain/printout.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "apps/common/terminal/text.h"

namespace presa {
namespace {

using nlohmann::json;
using terminal::format;

constexpr std::size_t kFigures = 76;  // column where the figures begin
constexpr std::size_t kWidth = 100;

std::string text(const json& value) { return value.get<std::string>(); }

std::string padded(std::string line, std::size_t width) {
  line.resize(std::max(width, line.size() + 1), ' ');
  return line;
}

// Microseconds, and the share of the period, of a module that was measured.
std::string figures(const json& module) {
  if (!module.contains("median_ns")) return {};
  const auto microseconds = [&](const char* key) {
    const double value = module[key].get<double>() * 1e-3;
    return format(value < 1e5 ? " %8.2f" : " %8.0f", value);
  };
  return microseconds("median_ns") + microseconds("p999_ns") +
         format(" %8.2f %%", 100 * module["share_of_period"].get<double>());
}

void line(std::string& out, const std::string& left, const json& module) {
  const std::string right = figures(module);
  // a long left side is not cut: the figures go to a line of their own
  if (!right.empty() && left.size() > kFigures) {
    out += left + '\n' + std::string(kFigures, ' ') + right + '\n';
  } else {
    out += (right.empty() ? left : padded(left, kFigures) + right) + '\n';
  }
}

void threads(std::string& out, const json& run) {
  const std::string title = "Threads, and what runs on them in order";
  out += (run.contains("cost") ? padded(title, kFigures) + "us median    p99.9  of period" : title) + '\n';
  for (const json& thread : run["threads"]) {
    out += format("\n  %s, %.0f Hz\n", text(thread["name"]).c_str(), thread["rate_hz"].get<double>());
    for (const json& module : run["modules"]) {
      if (module["group"] != thread["name"]) continue;
      line(out, "    " + padded(text(module["name"]), 16) + text(module["reason"]), module);
      int number = 0;
      for (const json& stage : run["stages"]) {
        if (stage["module"] == module["name"]) out += format("      %d. ", ++number) + text(stage["stage"]) + '\n';
      }
    }
  }
}

void crossings(std::string& out, const json& run) {
  for (const json& c : run["connections"]) {
    if (!c["across_rates"].get<bool>()) continue;
    out += "  " + padded(text(c["value"]), 22) + text(c["from"]) + " -> " + text(c["to"]);
    if (c.contains("when_old"))
      out += format(", older than %.0f ms: ", c["old_after_s"].get<double>() * 1e3) + text(c["when_old"]);
    out += '\n';
  }
}

void libraries(std::string& out, const json& run, bool plugins, const char* needed_by) {
  std::string row = " ";
  for (const json& library : run["libraries"]) {
    if (library["plugin"] != plugins || library["needed_by"] != needed_by) continue;
    const std::string name = ' ' + text(library["name"]);
    if (row.size() + name.size() > kWidth) {
      out += row + '\n';
      row = " ";
    }
    row += name;
  }
  out += row + '\n';
}

/// The highest frequencies first; a heap of bodies has a few lines, too.
void grasps(std::string& out, const json& run) {
  constexpr std::size_t kShown = 8;
  std::vector<json> all = run.value("grasps", std::vector<json>());
  if (all.empty()) return;
  std::ranges::stable_sort(all, std::ranges::greater(),
                           [](const json& grasp) { return grasp["natural_frequency_hz"].get<double>(); });
  out += "\nGrasps: a free body on the fingers' springs, its natural frequency, min mass for explicit coupling\n";
  for (std::size_t i = 0; i < std::min(all.size(), kShown); ++i) {
    const json& grasp = all[i];
    const auto number = [&](const char* key) { return grasp[key].get<double>(); };
    out += "  " + padded(text(grasp["body"]), 22) +
           format("%zu fingers of %.4g N/m on %.4g kg: %.1f Hz, %.3g kg\n", grasp["fingers"].get<std::size_t>(),
                  number("stiffness_N_m"), number("mass_kg"), number("natural_frequency_hz"),
                  number("explicit_min_mass_kg"));
  }
  if (all.size() > kShown) out += format("  and %zu more, with lower ones\n", all.size() - kShown);
}

/// One line for each; no heading without any.
void described(std::string& out, const json& run, const char* all, const char* name, const char* heading) {
  if (run.contains(all)) out += std::string("\n") + heading + '\n';
  for (const json& one : run.value(all, json::array()))
    out += "  " + padded(text(one[name]), 22) + text(one["what"]) + '\n';
}

}  // namespace

std::string explainText(const json& run) {
  std::string out = "Scene " + text(run["scene"]) + "\n\n";
  threads(out, run);
  if (run.contains("cost")) out += "\n  " + text(run["cost"]["time"]) + '\n';
  out += "\nDevices\n";
  for (const json& device : run["devices"]) {
    out += "  " + padded(text(device["role"]), 22) + "driver " + text(device["driver"]);
    for (const json& frame : device["frames"]) out += " in " + text(frame);
    out += '\n';
  }
  if (!run["decomposed"].empty()) out += "\nMeshes cut into convex pieces\n";
  for (const json& mesh : run["decomposed"]) out += "  " + text(mesh) + '\n';
  described(out, run, "frames", "name", "Frames that a user moves");
  described(out, run, "models", "body", "Bodies drawn as models");
  described(out, run, "joints", "name", "Joints");
  grasps(out, run);
  out += "\nValues that cross threads\n";
  crossings(out, run);
  out += "\nLeft out\n";
  for (const json& left_out : run["left_out"])
    out += "  " + padded(text(left_out["what"]), 22) + text(left_out["why"]) + '\n';
  out += "\nPlug-ins loaded\n";
  libraries(out, run, true, "the scene");
  out += "\nSystem libraries that came with them\n";
  libraries(out, run, false, "the scene");
  return out;
}

std::string explainDot(const json& run) {
  std::string out =
      "digraph \"" + text(run["scene"]) + "\" {\n  rankdir=LR; node [shape=box, style=rounded, fontname=\"sans\"];\n";
  for (const json& thread : run["threads"]) {
    const std::string name = text(thread["name"]);
    out += "  subgraph cluster_" + name + " { label=\"" + name + format(" %.0f Hz\";", thread["rate_hz"].get<double>());
    for (const json& module : run["modules"]) {
      if (module["group"] == thread["name"]) out += ' ' + text(module["name"]) + ';';
    }
    out += " }\n";
  }
  for (const json& c : run["connections"]) {
    out += "  " + text(c["from"]) + " -> " + text(c["to"]) + " [label=\"" + text(c["value"]) + '"' +
           (c["across_rates"].get<bool>() ? ", style=dashed" : "") + "];\n";
  }
  return out + "}\n";
}

}  // namespace presa
