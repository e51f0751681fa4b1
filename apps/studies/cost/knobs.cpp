#include "apps/studies/cost/knobs.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>
#include <sstream>

#include "apps/studies/cost/hash.h"
#include "framework/scene/load.h"

namespace presa::cost {
namespace {

struct KnownKnob {
  const char* name;
  const char* path;  ///< "device/*/…": every device
};

constexpr KnownKnob kKnobs[] = {
    {"haptic_rate", "rates/haptic"},
    {"collision_rate", "rates/collision"},
    {"dynamics_rate", "rates/dynamics"},
    {"substeps", "dynamics/substeps"},
    {"solver", "dynamics/solver"},
    {"iterations", "dynamics/iterations"},
    {"coupling", "dynamics/coupling"},
    {"engine", "dynamics/engine"},
    {"friction", "dynamics/friction"},
    {"rotation", "dynamics/rotation"},
    {"sleeping", "dynamics/sleeping"},
    {"renderer", "haptics/renderer"},
    {"pose", "haptics/pose"},
    {"patch_margin", "collision/margin"},
    {"fingertip_radius", "device/*/fingertip_radius"},
};

constexpr const char* kMeshKnob = "haptic_mesh";

std::vector<std::string> pathsOf(const std::string& path, const Scene& scene) {
  const std::size_t star = path.find('*');
  if (star == std::string::npos) return {path};
  std::vector<std::string> paths;
  for (const DeviceRole& role : scene.devices) paths.push_back(std::string(path).replace(star, 1, role.role));
  return paths;
}

std::vector<std::string> with(std::vector<std::string> sets, const std::vector<std::string>& more) {
  sets.insert(sets.end(), more.begin(), more.end());
  return sets;
}

struct Checked {
  Diagnostics diagnostics;
  std::uint64_t hash = 0;
};

Checked checkScene(const Inputs& inputs, const std::vector<std::string>& sets) {
  Checked checked;
  checked.hash = checkedScene(inputs, sets, checked.diagnostics);
  return checked;
}

/// Parses a fraction of the triangles, "1/4" or "0.25"; 0: not a fraction in (0, 1].
double partOf(const std::string& text) {
  char* end = nullptr;
  double part = std::strtod(text.c_str(), &end);
  if (*end == '/') part /= std::strtod(end + 1, &end);
  return *end == '\0' && part > 0 && part <= 1 ? part : 0;
}

/// The knob that replaces the haptic meshes of all bodies by decimated ones.
Knob meshKnob(const std::vector<std::string>& values, const Scene& scene, const std::string& folder,
              const SourceLocation& where, Diagnostics& diagnostics) {
  Knob knob{kMeshKnob, {}};
  for (const std::string& value : values) {
    if (value.empty()) continue;
    KnobValue& added = knob.values.emplace_back();
    added.name = value;
    const double part = partOf(value);
    if (part == 0)
      diagnostics.error(802, where, "haptic_mesh is a part of the triangles in (0, 1], found " + quote(value),
                        "for example haptic_mesh=1,1/4,1/16");
    for (const Body& body : scene.bodies) {
      const auto* mesh = body.haptic ? std::get_if<MeshRef>(&body.haptic->shape) : nullptr;
      if (mesh == nullptr || !(part > 0) || part == 1) continue;
      std::string suffix = value;
      std::replace(suffix.begin(), suffix.end(), '/', '_');
      const std::string file = folder + "/meshes/" + body.name + "_" + suffix + ".obj";
      added.sets.push_back("body/" + body.name + "/haptic/mesh/file=" + file);
      added.meshes.push_back({body.name, mesh->file, file, part});
    }
  }
  const bool any =
      std::any_of(knob.values.begin(), knob.values.end(), [](const KnobValue& v) { return !v.meshes.empty(); });
  if (!any && !knob.values.empty() && !diagnostics.hasErrors())
    diagnostics.error(802, where, "no body of the scene has a haptic mesh, or every value is 1");
  return knob;
}

/// All combinations, each with the index of every knob's value; SIZE_MAX: the scene's own value.
std::vector<std::vector<std::size_t>> combinations(const std::vector<Knob>& knobs, Combine combine) {
  constexpr std::size_t kNone = SIZE_MAX;
  std::vector<std::vector<std::size_t>> all;
  if (combine == Combine::kOneAtATime) {
    for (std::size_t k = 0; k < knobs.size(); ++k) {
      for (std::size_t v = 0; v < knobs[k].values.size(); ++v) {
        all.emplace_back(knobs.size(), kNone)[k] = v;
      }
    }
    return all;
  }
  std::vector<std::size_t> at(knobs.size(), 0);
  for (;;) {
    all.push_back(at);
    std::size_t k = knobs.size();
    while (k > 0 && ++at[k - 1] == knobs[k - 1].values.size()) at[--k] = 0;
    if (k == 0) return all;
  }
}

void report(const Diagnostics& found, std::set<std::string>& told, Diagnostics& diagnostics) {
  for (const Diagnostic& finding : found.all()) {
    if (finding.severity != Diagnostic::Severity::kError || !told.insert(format(finding)).second) continue;
    diagnostics.error(finding.code, finding.where, finding.message, finding.help);
  }
}

std::string firstError(const Diagnostics& found) {
  for (const Diagnostic& finding : found.all()) {
    if (finding.severity == Diagnostic::Severity::kError) return finding.message;
  }
  return {};
}

/// A line of XML with its attributes in alphabetical order.
std::string withSortedAttributes(const std::string& line) {
  std::vector<std::string> attributes;
  std::size_t begin = line.find(' ', line.find('<')), quote = 0;
  const std::string head = line.substr(0, begin);
  while (begin != std::string::npos && (quote = line.find('"', begin)) != std::string::npos) {
    const std::size_t end = line.find('"', quote + 1);
    if (end == std::string::npos) break;
    attributes.push_back(line.substr(begin, end + 1 - begin));
    begin = end + 1;
  }
  std::sort(attributes.begin(), attributes.end());
  std::string out = head;
  for (const std::string& attribute : attributes) out += attribute;
  return out + (begin == std::string::npos ? "" : line.substr(begin));
}

/// The parts of the scene in sorted order, so that it does not matter which defaults the file left out.
std::vector<std::string> sortedParts(const std::string& resolved_xml) {
  std::vector<std::string> parts{""};
  std::istringstream lines(resolved_xml);
  for (std::string line; std::getline(lines, line);) {
    const bool opens = (line.starts_with("  <") && !line.starts_with("  </")) || line.starts_with("</");
    if (opens) parts.emplace_back();
    parts.back() += withSortedAttributes(line) + "\n";
  }
  std::sort(parts.begin(), parts.end());
  return parts;
}

}  // namespace

std::vector<std::string> knobNames() {
  std::vector<std::string> names;
  for (const KnownKnob& knob : kKnobs) names.emplace_back(knob.name);
  names.emplace_back(kMeshKnob);
  return names;
}

std::uint64_t checkedScene(const Inputs& inputs, const std::vector<std::string>& sets, Diagnostics& diagnostics) {
  std::vector<Override> overrides;
  for (const std::string& set : with(inputs.sets, sets)) {
    const std::size_t equals = set.find('=');
    if (equals != std::string::npos) overrides.push_back({set.substr(0, equals), set.substr(equals + 1)});
  }
  Hash hash;
  for (const std::string& part : sortedParts(loadScene(inputs.scene, overrides, diagnostics).resolved_xml))
    hash.add(part);
  return hash.value();
}

Knob makeKnob(const std::string& name, const std::vector<std::string>& values, const Scene& scene,
              const std::string& folder, const SourceLocation& where, Diagnostics& diagnostics) {
  const auto known =
      std::find_if(std::begin(kKnobs), std::end(kKnobs), [&](const KnownKnob& k) { return k.name == name; });
  if (known == std::end(kKnobs) && name.find('/') == std::string::npos && name != kMeshKnob) {
    std::string list;
    for (const std::string& each : knobNames()) list += (list.empty() ? "" : ", ") + each;
    diagnostics.error(801, where, "there is no knob " + quote(name) + didYouMean(name, knobNames()),
                      "a knob is a path as after --set, such as material/rubber/damping, or one of: " + list);
    return {};
  }
  Knob knob = name == kMeshKnob ? meshKnob(values, scene, folder, where, diagnostics) : Knob{name, {}};
  const std::vector<std::string> paths = pathsOf(known == std::end(kKnobs) ? name : known->path, scene);
  for (const std::string& value : values) {
    if (value.empty() || name == kMeshKnob) continue;
    KnobValue& added = knob.values.emplace_back();
    added.name = value;
    for (const std::string& path : paths) added.sets.push_back(path + "=" + value);
  }
  if (knob.values.empty())
    diagnostics.error(802, where, "knob " + quote(name) + " has no values", "for example dynamics_rate=100,200,500");
  return knob;
}

void addSettings(Study& study, const std::vector<Knob>& knobs, Combine combine, Diagnostics& diagnostics) {
  const Checked base = checkScene(study.inputs, {});
  if (base.diagnostics.hasErrors()) return;  // reported by the caller
  if (study.settings.empty()) {
    Setting& first = study.settings.emplace_back();
    first.scene_hash = base.hash;
  }
  // a value is an error only if every combination with it is
  std::map<std::pair<std::size_t, std::size_t>, Diagnostics> why;
  std::set<std::pair<std::size_t, std::size_t>> good;
  for (const std::vector<std::size_t>& combination : combinations(knobs, combine)) {
    Setting setting;
    for (std::size_t k = 0; k < knobs.size(); ++k) {
      if (combination[k] == SIZE_MAX) continue;
      const KnobValue& value = knobs[k].values[combination[k]];
      setting.sets = with(std::move(setting.sets), value.sets);
      setting.choices.emplace_back(knobs[k].name, value.name);
    }
    const Checked checked = checkScene(study.inputs, setting.sets);
    setting.scene_hash = checked.hash;
    setting.impossible = firstError(checked.diagnostics);
    for (std::size_t k = 0; k < knobs.size(); ++k) {
      if (combination[k] == SIZE_MAX) continue;
      if (setting.impossible.empty())
        good.insert({k, combination[k]});
      else
        why.try_emplace({k, combination[k]}, checked.diagnostics);
    }
    const auto same = std::find_if(study.settings.begin(), study.settings.end(), [&](const Setting& s) {
      return setting.impossible.empty() ? s.impossible.empty() && s.scene_hash == setting.scene_hash
                                        : s.sets == setting.sets;
    });
    if (same == study.settings.end()) {
      study.settings.push_back(std::move(setting));
    } else if (same->choices.size() < setting.choices.size()) {
      same->choices = setting.choices;
    }
  }
  std::set<std::string> told;
  for (const auto& [value, found] : why) {
    if (!good.contains(value)) report(found, told, diagnostics);
  }
  for (const Knob& knob : knobs) {
    const auto known =
        std::find_if(study.knobs.begin(), study.knobs.end(), [&](const Knob& k) { return k.name == knob.name; });
    if (known == study.knobs.end()) {
      study.knobs.push_back(knob);
      continue;
    }
    for (const KnobValue& value : knob.values) {
      const bool has = std::any_of(known->values.begin(), known->values.end(),
                                   [&](const KnobValue& v) { return v.name == value.name; });
      if (!has) known->values.push_back(value);
    }
  }
}

void nameSettings(Study& study) {
  if (study.settings.empty()) return;
  const std::uint64_t base = study.settings.front().scene_hash;
  std::map<std::string, std::string> usual;  // the scene's own value of each knob
  for (const Knob& knob : study.knobs) {
    usual[knob.name] = "as in the scene";
    for (const KnobValue& value : knob.values) {
      const Checked alone = checkScene(study.inputs, value.sets);
      if (!alone.diagnostics.hasErrors() && alone.hash == base) usual[knob.name] = value.name;
    }
  }
  for (Setting& setting : study.settings) {
    const std::map<std::string, std::string> chosen(setting.choices.begin(), setting.choices.end());
    setting.choices.clear();
    std::vector<std::string> needed;  // only the sets that differ from the scene
    for (const Knob& knob : study.knobs) {
      const auto found = chosen.find(knob.name);
      const std::string& value = found == chosen.end() ? usual[knob.name] : found->second;
      setting.choices.emplace_back(knob.name, value);
      if (value == usual[knob.name]) continue;
      setting.name += (setting.name.empty() ? "" : ", ") + knob.name + " " + value;
      for (const KnobValue& each : knob.values) {
        if (each.name == value) needed = with(std::move(needed), each.sets);
      }
    }
    const Checked shorter = checkScene(study.inputs, needed);
    if (!shorter.diagnostics.hasErrors() && shorter.hash == setting.scene_hash) setting.sets = needed;
    if (setting.name.empty()) setting.name = "default";
  }
}

bool hasMotion(const Plan& plan) {
  return std::any_of(plan.modules.begin(), plan.modules.end(),
                     [](const PlannedModule& module) { return module.group == RateGroup::kDynamics; });
}

std::vector<Knob> defaultKnobs(const Loaded& base, const std::string& folder, bool quick) {
  const Scene& scene = base.world->scene;
  const bool moves = hasMotion(base.plan), touches = !scene.devices.empty(), meshes = base.plan.has("collision_fcl");
  std::size_t solid = 0;
  for (const Body& body : scene.bodies) solid += body.physics ? 1 : 0;
  Diagnostics ignored;
  std::vector<Knob> knobs;
  const auto add = [&](const char* name, const std::vector<std::string>& values) {
    Knob knob = makeKnob(name, values, scene, folder, {}, ignored);
    // skip values incompatible with the scene's other rates; the user did not ask for them
    std::erase_if(knob.values, [&](const KnobValue& value) {
      return checkScene({scene.file, "", {}}, value.sets).diagnostics.hasErrors();
    });
    if (!knob.values.empty()) knobs.push_back(std::move(knob));
  };
  if (moves)
    add("dynamics_rate", quick ? std::vector<std::string>{"100", "200", "500"}
                               : std::vector<std::string>{"50", "100", "200", "250", "500", "1000"});
  if (touches)
    add("haptic_rate", quick ? std::vector<std::string>{"1000", "2000"}
                             : std::vector<std::string>{"400", "500", "1000", "2000", "4000"});
  if (moves && touches) add("coupling", {"soft", "explicit"});
  if (moves && touches) add("pose", {"interpolate", "hold"});
  if (meshes)
    add("collision_rate",
        quick ? std::vector<std::string>{"50", "100"} : std::vector<std::string>{"25", "50", "100", "200", "500"});
  if (quick) return knobs;
  if (touches) add("renderer", {"god_object", "penalty"});
  if (moves) {
    add("substeps", {"1", "2", "4", "8"});
    add("solver", {"auto", "direct", "iterative"});
    add("rotation", {"exact", "engine", "none", "euler", "matrix"});
  }
  if (moves && solid > 1) add("friction", {"isotropic", "pyramid"});
  if (meshes) {
    add("haptic_mesh", {"1/2", "1/8", "1/32"});
    add("patch_margin", {"0.001", "0.002", "0.004"});
    add("fingertip_radius", {"0.002", "0.004", "0.008", "0.012"});
  }
  return knobs;
}

}  // namespace presa::cost
