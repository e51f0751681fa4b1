#include "apps/studies/cost/finer_knobs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "apps/studies/cost/analysis.h"
#include "framework/scene/manifest.h"
#include "framework/scene/scene.h"
#include "framework/scene/xml/value_rule.h"

namespace presa::cost {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

void addKnobs(const Manifest& manifest, const Scene* scene, std::vector<FinerKnob>& knobs) {
  for (const Manifest::Element& element : manifest.elements) {
    const PluginElement* in_scene = nullptr;
    for (const PluginElement& each : scene != nullptr ? scene->plugin_elements : std::vector<PluginElement>{})
      if (each.element == element.name) in_scene = &each;
    for (const Manifest::Attribute& attribute : element.attributes) {
      if (attribute.finer.empty()) continue;
      const std::string& value = in_scene != nullptr ? in_scene->text(attribute.name) : attribute.default_value;
      knobs.push_back({.name = attribute.name,
                       .path = "haptics/" + element.name + "/" + attribute.name,
                       .finer = attribute.finer == "up" ? Direction::kUp : Direction::kDown,
                       .tried = attribute.tried,
                       .value = numberIn(value).value_or(0),
                       .above = numberIn(attribute.above).value_or(-kNone),
                       .min = numberIn(attribute.min).value_or(-kNone),
                       .max = numberIn(attribute.max).value_or(kNone)});
    }
  }
}

/// The values of the scene and of the factors, coarse to fine; without 0, where the renderer chooses.
std::vector<double> ownValues(const FinerKnob& knob, const std::vector<Factor>& factors) {
  std::set<double> values{knob.value};
  for (const Factor& factor : factors)
    for (const FactorValue& value : factor.values)
      for (const std::string& set : value.sets)
        if (set.starts_with(knob.path + "=")) values.insert(numberIn(set.substr(knob.path.size() + 1)).value_or(0));
  std::erase_if(values, [](double value) { return !(value > 0); });
  return knob.finer == Direction::kUp ? std::vector<double>(values.begin(), values.end())
                                      : std::vector<double>(values.rbegin(), values.rend());
}

}  // namespace

std::vector<FinerKnob> finerKnobs(const Scene& scene) {
  std::vector<FinerKnob> knobs;
  const auto add = [&](const std::string& plugin) {
    if (const Manifest* manifest = findManifest(plugin)) addKnobs(*manifest, &scene, knobs);
  };
  if (scene.hasFingertips()) add(scene.haptics.renderer);
  if (scene.hasTools()) add(scene.haptics.tool_renderer);
  return knobs;
}

std::vector<FinerKnob> allFinerKnobs() {
  std::vector<FinerKnob> knobs;
  for (const Manifest& manifest : manifests()) {
    if (manifest.kind == PluginKind::kRenderer || manifest.kind == PluginKind::kToolRenderer)
      addKnobs(manifest, nullptr, knobs);
  }
  return knobs;
}

std::vector<std::vector<std::string>> finerSets(const Scene& scene, const std::vector<Factor>& factors,
                                                std::size_t levels) {
  std::vector<std::vector<std::string>> all;
  for (const FinerKnob& knob : finerKnobs(scene)) {
    std::vector<double> values = ownValues(knob, factors);
    if (values.empty()) continue;
    for (std::size_t level = 0; level < levels; ++level) {
      const double finest = values.back(), next = knob.finer == Direction::kUp ? 2 * finest : finest / 2;
      const double within = std::clamp(next, knob.min, knob.max);
      values.push_back(within > knob.above ? within : finest);
    }
    std::vector<std::string>& sets = all.emplace_back();
    for (const double value : values) sets.push_back(knob.path + "=" + xml::numberText(value));
  }
  return all;
}

}  // namespace presa::cost
