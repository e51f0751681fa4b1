#include "apps/studies/cost/factors.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>
#include <sstream>

#include "apps/common/file_text.h"
#include "apps/studies/cost/condition_factor.h"
#include "apps/studies/cost/finer_knobs.h"
#include "apps/studies/cost/hash.h"
#include "apps/studies/cost/law_factor.h"
#include "framework/scene/load.h"
#include "framework/scene/manifest.h"
#include "framework/scene/xml/value_rule.h"

namespace presa::cost {
namespace {

/// What a scene must have for a knob to do something.
enum class Need { kNothing, kFingers, kFingertips, kMotion, kHeldMotion, kMeshes };

struct KnownFactor {
  const char* name;
  const char* path;  ///< "device/*/…": every device
  Need need;
  Direction finer = Direction::kNone;  ///< where errors fall as a power of it
};

constexpr KnownFactor kFactors[] = {
    {"haptic_rate", "rates/haptic", Need::kNothing, Direction::kUp},  // its ticks cost time, also without a finger
    {"collision_rate", "rates/collision", Need::kMeshes},
    {"dynamics_rate", "rates/dynamics", Need::kMotion, Direction::kUp},
    {"substeps", "dynamics/substeps", Need::kMotion, Direction::kUp},
    {"solver", "dynamics/solver", Need::kMotion},
    {"iterations", "dynamics/iterations", Need::kMotion},
    {"coupling", "dynamics/coupling", Need::kHeldMotion},
    {"engine", "dynamics/engine", Need::kMotion},
    {"friction", "dynamics/friction", Need::kMotion},
    {"rotation", "dynamics/rotation", Need::kMotion},
    {"sleeping", "dynamics/sleeping", Need::kMotion},
    {"renderer", "haptics/renderer", Need::kFingertips},
    {"pose", "haptics/pose", Need::kHeldMotion},
    {"collision_index", "collision/index", Need::kMeshes},
    {"patch_margin", "collision/margin", Need::kMeshes},
    {"fingertip_radius", "device/*/fingertip_radius", Need::kFingertips},
    {"latency", "run/latency", Need::kFingers},
    {"haptic_jitter", "run/haptic_jitter", Need::kFingers},
    {"collision_jitter", "run/collision_jitter", Need::kMeshes},
    {"dynamics_jitter", "run/dynamics_jitter", Need::kHeldMotion},
};

constexpr const char *kMeshFactor = "haptic_mesh", *kMeshFolder = "/meshes/";  // of a study's own folder

std::vector<std::string> pathsOf(const std::string& path, const Scene& scene) {
  const std::size_t star = path.find('*');
  if (star == std::string::npos) return {path};
  std::vector<std::string> paths;
  for (const DeviceRole& role : scene.devices) paths.push_back(std::string(path).replace(star, 1, role.role));
  return paths;
}

/// A knob of the scene's own renderers, or else of another one, by its name or path; none: there is no such knob.
std::optional<FinerKnob> finerKnob(const std::string& name, const Scene& scene) {
  for (const std::vector<FinerKnob>& knobs : {finerKnobs(scene), allFinerKnobs()})
    for (const FinerKnob& knob : knobs)
      if (knob.name == name || knob.path == name) return knob;
  return std::nullopt;
}

std::vector<std::string> with(std::vector<std::string> sets, const std::vector<std::string>& more) {
  sets.insert(sets.end(), more.begin(), more.end());
  return sets;
}

/// Files of the meshes that are felt or collide, in the order of the scene.
std::vector<std::string> meshesOf(const Scene& scene) {
  std::vector<std::string> files;
  const auto add = [&](const Shape& shape) {
    if (const auto* mesh = std::get_if<MeshRef>(&shape)) files.push_back(mesh->file);
  };
  const auto addAll = [&](const Shape& shape) {
    add(shape);
    if (const auto* compound = std::get_if<Compound>(&shape))
      for (const ShapePart& part : compound->parts) add(part.shape);
  };
  for (const Body& body : scene.bodies) {
    if (body.haptic) addAll(body.haptic->shape);
    if (body.physics) addAll(body.physics->shape);
  }
  return files;
}

/// Hash of a file's content, read once in a process.
std::string contentHash(const std::string& file) {
  static std::map<std::string, std::string> known;
  const auto [found, is_new] = known.try_emplace(file);
  if (is_new) {
    Hash hash;
    hash.add(contentsOf(file));
    found->second = std::to_string(hash.value());
  }
  return found->second;
}

struct Checked {
  Diagnostics diagnostics;
  std::uint64_t hash = 0;
};

Checked checkScene(const Inputs& inputs, const std::vector<std::string>& sets, const std::string& folder) {
  Checked checked;
  checked.hash = checkedScene(inputs, sets, folder, checked.diagnostics);
  return checked;
}

/// Parses a fraction of the triangles, "1/4" or "0.25"; 0: not a fraction in (0, 1].
double partOf(const std::string& text) {
  char* end = nullptr;
  double part = std::strtod(text.c_str(), &end);
  if (*end == '/') part /= std::strtod(end + 1, &end);
  return *end == '\0' && part > 0 && part <= 1 ? part : 0;
}

/// The factor that replaces the haptic meshes of all bodies by decimated ones.
Factor meshFactor(const std::vector<std::string>& values, const Scene& scene, const std::string& folder,
                  const SourceLocation& where, Diagnostics& diagnostics) {
  Factor factor{kMeshFactor, {}};
  for (const std::string& value : values) {
    if (value.empty()) continue;
    FactorValue& added = factor.values.emplace_back();
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
      const std::string file = folder + kMeshFolder + body.name + "_" + suffix + ".obj";
      added.sets.push_back("body/" + body.name + "/haptic/mesh/file=" + file);
      added.meshes.push_back({body.name, mesh->file, file, part});
    }
  }
  const bool any =
      std::any_of(factor.values.begin(), factor.values.end(), [](const FactorValue& v) { return !v.meshes.empty(); });
  if (!any && !factor.values.empty() && !diagnostics.hasErrors())
    diagnostics.error(802, where, "no body of the scene has a haptic mesh, or every value is 1");
  return factor;
}

/// All combinations, each with the index of every factor's value; SIZE_MAX: the scene's own value.
std::vector<std::vector<std::size_t>> combinations(const std::vector<Factor>& factors, Combine combine) {
  constexpr std::size_t kNone = SIZE_MAX;
  std::vector<std::vector<std::size_t>> all;
  if (combine == Combine::kOneAtATime) {
    for (std::size_t k = 0; k < factors.size(); ++k) {
      for (std::size_t v = 0; v < factors[k].values.size(); ++v) {
        all.emplace_back(factors.size(), kNone)[k] = v;
      }
    }
    return all;
  }
  std::vector<std::size_t> at(factors.size(), 0);
  for (;;) {
    all.push_back(at);
    std::size_t k = factors.size();
    while (k > 0 && ++at[k - 1] == factors[k - 1].values.size()) at[--k] = 0;
    if (k == 0) return all;
  }
}

void report(const Diagnostics& found, std::set<std::string>& reported, Diagnostics& diagnostics) {
  for (const Diagnostic& finding : found.all()) {
    if (finding.severity != Diagnostic::Severity::kError || !reported.insert(format(finding)).second) continue;
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

std::vector<std::string> factorNames() {
  std::vector<std::string> names;
  for (const KnownFactor& factor : kFactors) names.emplace_back(factor.name);
  names.emplace_back(kMeshFactor);
  names.emplace_back(kLawFactor);
  for (const FinerKnob& knob : allFinerKnobs())
    if (std::ranges::find(names, knob.name) == names.end()) names.push_back(knob.name);
  return names;
}

Direction directionOf(const std::string& factor, const Scene& scene) {
  for (const KnownFactor& known : kFactors)
    if (known.name == factor || known.path == factor) return known.finer;
  const std::optional<FinerKnob> knob = finerKnob(factor, scene);
  return knob ? knob->finer : Direction::kNone;
}

std::uint64_t checkedScene(const Inputs& inputs, const std::vector<std::string>& sets, const std::string& folder,
                           Diagnostics& diagnostics) {
  std::vector<Override> overrides;
  std::vector<std::string> all = with(inputs.sets, sets);
  const Conditions conditions = takeConditions(all, diagnostics);
  for (const std::string& set : all) {
    const std::size_t equals = set.find('=');
    if (equals != std::string::npos) overrides.push_back({set.substr(0, equals), set.substr(equals + 1)});
  }
  Hash hash;
  if (conditions != Conditions{}) hash.add(toText(conditions));
  const Scene scene = loadScene(inputs.scene, overrides, diagnostics);
  const std::string own = folder + kMeshFolder;
  std::string resolved = scene.resolved_xml;
  for (std::size_t at = 0; !folder.empty() && (at = resolved.find(own, at)) != std::string::npos;)
    resolved.erase(at, folder.size());
  for (const std::string& part : sortedParts(resolved)) hash.add(part);
  for (const std::string& file : meshesOf(scene)) {
    if (folder.empty() || !file.starts_with(own)) hash.add(contentHash(file));
  }
  return hash.value();
}

Factor makeFactor(const std::string& name, const std::vector<std::string>& values, const Scene& scene,
                  const std::string& folder, const SourceLocation& where, Diagnostics& diagnostics) {
  const auto known =
      std::find_if(std::begin(kFactors), std::end(kFactors), [&](const KnownFactor& k) { return k.name == name; });
  const bool special = name == kMeshFactor || name == kLawFactor;
  const std::optional<FinerKnob> finer = finerKnob(name, scene);
  if (known == std::end(kFactors) && !finer && name.find('/') == std::string::npos && !special) {
    std::string list;
    for (const std::string& each : factorNames()) list += (list.empty() ? "" : ", ") + each;
    diagnostics.error(801, where, "there is no knob " + quote(name) + didYouMean(name, factorNames()),
                      "a knob is a path as after --set, such as material/rubber/damping, or one of: " + list);
    return {};
  }
  Factor factor = name == kMeshFactor  ? meshFactor(values, scene, folder, where, diagnostics)
                  : name == kLawFactor ? lawFactor(values, scene, where, diagnostics)
                                       : Factor{name, {}};
  const std::vector<std::string> paths = pathsOf(known != std::end(kFactors) ? known->path
                                                 : finer                     ? finer->path
                                                                             : name,
                                                 scene);
  for (const std::string& value : values) {
    if (value.empty() || special) continue;
    FactorValue& added = factor.values.emplace_back();
    added.name = value;
    for (const std::string& path : paths) added.sets.push_back(path + "=" + value);
  }
  if (factor.values.empty())
    diagnostics.error(802, where, "knob " + quote(name) + " has no values", "for example dynamics_rate=100,200,500");
  return factor;
}

void addSettings(Study& study, const std::vector<Factor>& factors, Combine combine, Diagnostics& diagnostics) {
  const Checked base = checkScene(study.inputs, {}, study.folder);
  if (base.diagnostics.hasErrors()) return;  // reported by the caller
  if (study.settings.empty()) {
    Setting& first = study.settings.emplace_back();
    first.scene_hash = base.hash;
  }
  // a value is an error only if every combination with it is
  std::map<std::pair<std::size_t, std::size_t>, Diagnostics> why;
  std::set<std::pair<std::size_t, std::size_t>> good;
  for (const std::vector<std::size_t>& combination : combinations(factors, combine)) {
    Setting setting;
    for (std::size_t k = 0; k < factors.size(); ++k) {
      if (combination[k] == SIZE_MAX) continue;
      const FactorValue& value = factors[k].values[combination[k]];
      setting.sets = with(std::move(setting.sets), value.sets);
      setting.choices.emplace_back(factors[k].name, value.name);
    }
    const Checked checked = checkScene(study.inputs, setting.sets, study.folder);
    setting.scene_hash = checked.hash;
    setting.impossible = firstError(checked.diagnostics);
    for (std::size_t k = 0; k < factors.size(); ++k) {
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
  std::set<std::string> reported;
  for (const auto& [value, found] : why) {
    if (!good.contains(value)) report(found, reported, diagnostics);
  }
  for (const Factor& factor : factors) {
    const auto known = std::find_if(study.factors.begin(), study.factors.end(),
                                    [&](const Factor& k) { return k.name == factor.name; });
    if (known == study.factors.end()) {
      study.factors.push_back(factor);
      continue;
    }
    for (const FactorValue& value : factor.values) {
      const bool has = std::any_of(known->values.begin(), known->values.end(),
                                   [&](const FactorValue& v) { return v.name == value.name; });
      if (!has) known->values.push_back(value);
    }
  }
}

void nameSettings(Study& study) {
  if (study.settings.empty()) return;
  const std::uint64_t base = study.settings.front().scene_hash;
  std::map<std::string, std::string> usual;  // the scene's own value of each factor
  for (const Factor& factor : study.factors) {
    const auto own = std::ranges::find_if(factor.values, [&](const FactorValue& value) {
      const Checked alone = checkScene(study.inputs, value.sets, study.folder);
      return !alone.diagnostics.hasErrors() && alone.hash == base;
    });
    usual[factor.name] = own == factor.values.end() ? "as in the scene" : own->name;
  }
  for (Setting& setting : study.settings) {
    const std::map<std::string, std::string> chosen(setting.choices.begin(), setting.choices.end());
    setting.choices.clear();
    std::vector<std::string> needed;  // only the sets that differ from the scene
    for (const Factor& factor : study.factors) {
      const auto found = chosen.find(factor.name);
      const std::string& value = found == chosen.end() ? usual[factor.name] : found->second;
      setting.choices.emplace_back(factor.name, value);
      if (value == usual[factor.name]) continue;
      setting.name += (setting.name.empty() ? "" : ", ") + factor.name + " " + value;
      for (const FactorValue& each : factor.values) {
        if (each.name == value) needed = with(std::move(needed), each.sets);
      }
    }
    const Checked shorter = checkScene(study.inputs, needed, study.folder);
    if (!shorter.diagnostics.hasErrors() && shorter.hash == setting.scene_hash) setting.sets = needed;
    if (setting.name.empty()) setting.name = "default";
  }
}

/// What the scene lacks for it; empty: nothing.
static std::string lackFor(Need need, const Loaded& base) {
  const bool moves = hasMotion(base.plan), touches = !base.world->scene.devices.empty();
  if ((need == Need::kMotion || need == Need::kHeldMotion) && !moves) return "nothing in it moves";
  if ((need == Need::kFingers || need == Need::kHeldMotion) && !touches) return "it has no finger";
  if (need == Need::kFingertips && !base.world->scene.hasFingertips()) return "it has no fingertip";
  if (need == Need::kMeshes && !base.plan.has("collision_fcl")) return "no finger of it touches a mesh";
  return {};
}

void checkUse(const Factor& factor, const Loaded& base, const SourceLocation& where, Diagnostics& diagnostics) {
  std::string lack, used;
  for (const KnownFactor& known : kFactors) {
    const std::string lacks = lackFor(known.need, base);
    if (known.name == factor.name) lack = lacks;
    if (lacks.empty()) used += (used.empty() ? "" : ", ") + std::string(known.name);
  }
  const std::optional<FinerKnob> knob = finerKnob(factor.name, base.world->scene);
  if (knob) lack = "no renderer of it has one";
  for (const FinerKnob& own : finerKnobs(base.world->scene)) {
    if (knob && own.path == knob->path) lack.clear();
    used += (used.empty() ? "" : ", ") + own.name;
  }
  if (lack.empty()) return;
  diagnostics.error(816, where, "knob " + quote(factor.name) + " does nothing in this scene: " + lack,
                    used.empty() ? "no named knob does" : "knobs that do something: " + used);
}

bool hasMotion(const Plan& plan) {
  return std::any_of(plan.modules.begin(), plan.modules.end(),
                     [](const PlannedModule& module) { return module.group == RateGroup::kDynamics; });
}

/// The renderers that are installed.
static std::vector<std::string> renderers() {
  std::vector<std::string> names;
  for (const Manifest& manifest : manifests()) {
    if (manifest.kind == PluginKind::kRenderer) names.push_back(manifest.name);
  }
  return names;
}

std::vector<Factor> defaultFactors(const Loaded& base, const std::string& folder, bool quick) {
  const Scene& scene = base.world->scene;
  const bool moves = hasMotion(base.plan), touches = !scene.devices.empty(), meshes = base.plan.has("collision_fcl");
  std::size_t solid = 0;
  for (const Body& body : scene.bodies) solid += body.physics ? 1 : 0;
  Diagnostics ignored;
  std::vector<Factor> factors;
  const auto add = [&](const char* name, const std::vector<std::string>& values) {
    Factor factor = makeFactor(name, values, scene, folder, {}, ignored);
    // skip values incompatible with the scene's other rates; the user did not ask for them
    std::erase_if(factor.values, [&](const FactorValue& value) {
      return checkScene({scene.file, "", {}}, value.sets, "").diagnostics.hasErrors();
    });
    if (factor.values.empty()) return false;
    factors.push_back(std::move(factor));
    return true;
  };
  if (moves)
    add("dynamics_rate", quick ? std::vector<std::string>{"100", "200", "500"}
                               : std::vector<std::string>{"50", "100", "200", "250", "500", "1000"});
  const bool usual_rates =
      touches && add("haptic_rate", quick ? std::vector<std::string>{"1000", "2000"}
                                          : std::vector<std::string>{"400", "500", "1000", "2000", "4000"});
  if (touches && !usual_rates)  // the scene's other rates do not fit to them
    add("haptic_rate", {xml::numberText(2 * scene.rates.haptic), xml::numberText(4 * scene.rates.haptic)});
  if (moves && touches)
    add("coupling", quick ? std::vector<std::string>{"soft", "explicit"}
                          : std::vector<std::string>{"soft", "explicit", "averaged", "haptic_rate"});
  if (moves && touches) add("pose", {"interpolate", "hold"});
  if (meshes)
    add("collision_rate",
        quick ? std::vector<std::string>{"50", "100"} : std::vector<std::string>{"25", "50", "100", "200", "500"});
  if (quick) return factors;
  if (scene.hasFingertips()) add("renderer", renderers());
  for (const FinerKnob& knob : finerKnobs(scene)) add(knob.name.c_str(), knob.tried);
  if (moves) {
    add("substeps", {"1", "2", "4", "8"});
    add("solver", {"auto", "direct", "iterative", "newton", "small_steps"});
    add("rotation", {"exact", "engine", "none", "euler", "matrix"});
  }
  if (moves && solid > 1) add("friction", {"isotropic", "pyramid"});
  if (meshes) {
    add("haptic_mesh", {"1/2", "1/8", "1/32"});
    add("patch_margin", {"0.001", "0.002", "0.004"});
    add("fingertip_radius", {"0.002", "0.004", "0.008", "0.012"});
  }
  return factors;
}

}  // namespace presa::cost
