#include "apps/studies/cost/law_factor.h"

#include <algorithm>
#include <map>
#include <set>

#include "framework/haptics/friction_laws.h"
#include "framework/scene/manifest.h"

namespace presa::cost {
namespace {

/// Values of required attributes where the knob gives none.
struct UsualValue {
  const char* element;
  const char* attribute;
  const char* value;
};
constexpr UsualValue kUsual[] = {{"viscous", "damping", "2"},       {"stribeck", "speed", "0.02"},
                                 {"dahl", "stiffness", "1000"},     {"lugre", "stiffness", "1000"},
                                 {"lugre", "speed", "0.02"},        {"membrane", "stiffness", "500"},
                                 {"anisotropic", "grain", "1 0 0"}, {"anisotropic", "across", "1.5"}};

std::string usualOf(const std::string& element, const std::string& attribute) {
  for (const UsualValue& usual : kUsual) {
    if (element == usual.element && attribute == usual.attribute) return usual.value;
  }
  return {};
}

std::vector<std::string> lawNames() {
  std::vector<std::string> names;
  for (const Manifest& manifest : manifests()) {
    if (manifest.kind == PluginKind::kFrictionLaw) names.push_back(manifest.name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::string> splitAt(char separator, const std::string& text) {
  std::vector<std::string> parts{""};
  for (const char c : text) {
    if (c == separator)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

/// Materials with friction of bodies that a finger can touch.
std::set<std::size_t> rubbedMaterials(const Scene& scene) {
  std::set<std::size_t> rubbed;
  for (const Body& body : scene.bodies) {
    const auto material = static_cast<std::size_t>(body.material);
    if (body.haptic && hasFriction(scene, material)) rubbed.insert(material);
  }
  return rubbed;
}

class LawReader {
 public:
  LawReader(const Scene& scene, const SourceLocation& where, Diagnostics& diagnostics)
      : scene_(scene), where_(where), diagnostics_(diagnostics) {}

  std::vector<std::string> setsOf(const std::string& text) const {
    const std::vector<std::string> parts = splitAt(':', text);
    const Manifest* law = findManifest(parts[0]);
    if (law == nullptr || law->kind != PluginKind::kFrictionLaw) {
      std::string list;
      for (const std::string& name : lawNames()) list += (list.empty() ? "" : ", ") + name;
      fail("there is no friction law " + quote(parts[0]) + didYouMean(parts[0], lawNames()), "laws: " + list);
      return {};
    }
    const std::map<std::string, std::string> given = valuesOf(*law, parts);
    std::vector<std::string> sets;
    for (const std::size_t material : rubbedMaterials(scene_)) {
      const std::string& name = scene_.materials[material].name;
      const PluginElement* written = frictionElementOf(scene_, material);
      if (written != nullptr && written->plugin != law->name) {
        fail("material " + quote(name) + " names its law, <" + written->element + ">, which a knob cannot take out",
             "write its <friction> without a law in the scene");
        return {};
      }
      for (const Manifest::Element& element : law->elements) {
        for (const auto& [attribute, value] : given) {
          // a law that the scene names keeps its values, but for those that the knob gives
          if (written == nullptr || text.find(":" + attribute + "=") != std::string::npos)
            sets.push_back("material/" + name + "/friction/" + element.name + "/" + attribute + "=" + value);
        }
      }
    }
    return sets;
  }

 private:
  void fail(const std::string& message, const std::string& help) const {
    diagnostics_.error(802, where_, message, help);
  }

  /// Values of the law's element: those given, and the usual ones of what it requires.
  std::map<std::string, std::string> valuesOf(const Manifest& law, const std::vector<std::string>& parts) const {
    std::map<std::string, std::string> values;
    for (const Manifest::Element& element : law.elements) {
      for (const Manifest::Attribute& attribute : element.attributes) {
        const bool first = &attribute == &element.attributes.front();
        const std::string usual = attribute.required ? usualOf(element.name, attribute.name)
                                  : first            ? attribute.default_value
                                                     : "";
        if (!usual.empty()) values[attribute.name] = usual;
      }
    }
    for (std::size_t i = 1; i < parts.size(); ++i) {
      const std::size_t equals = parts[i].find('=');
      if (equals == std::string::npos || equals == 0)
        fail("expected ATTRIBUTE=VALUE after " + quote(law.name + ":") + ", found " + quote(parts[i]),
             "for example law=friction_stribeck:speed=0.02");
      else
        values[parts[i].substr(0, equals)] = parts[i].substr(equals + 1);
    }
    for (const Manifest::Element& element : law.elements) {
      for (const Manifest::Attribute& attribute : element.attributes) {
        if (attribute.required && !values.contains(attribute.name))
          fail(quote(law.name) + " needs a value for " + quote(attribute.name),
               "write " + law.name + ":" + attribute.name + "=VALUE");
      }
    }
    return values;
  }

  const Scene& scene_;
  const SourceLocation& where_;
  Diagnostics& diagnostics_;
};

}  // namespace

Factor lawFactor(const std::vector<std::string>& values, const Scene& scene, const SourceLocation& where,
                 Diagnostics& diagnostics) {
  Factor factor{kLawFactor, {}};
  if (rubbedMaterials(scene).empty() && !diagnostics.hasErrors())
    diagnostics.error(802, where, "no material that a finger can touch has friction", "give one a <friction>");
  const LawReader reader(scene, where, diagnostics);
  for (const std::string& value : values) {
    if (value.empty()) continue;
    FactorValue& added = factor.values.emplace_back();
    added.name = value;
    added.sets = reader.setsOf(value);
  }
  return factor;
}

}  // namespace presa::cost
