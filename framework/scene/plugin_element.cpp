#include "framework/scene/plugin_element.h"

#include <algorithm>
#include <stdexcept>

#include "framework/scene/manifest.h"
#include "framework/scene/scene_parts.h"
#include "framework/scene/xml/value_rule.h"

namespace presa {
namespace {

std::vector<double> numbersOf(const PluginElement& element, const std::string& attribute, std::size_t count) {
  std::vector<double> values;
  for (const std::string& word : xml::splitWords(element.text(attribute))) {
    double value = 0;
    if (xml::readNumber(word, value) == xml::NumberKind::kFinite) values.push_back(value);
  }
  if (values.size() == count) return values;
  throw std::logic_error("the manifest of plug-in '" + element.plugin + "' gives <" + element.element + " " +
                         attribute + "> another type than its library expects");
}

}  // namespace

double PluginElement::number(const std::string& attribute) const { return numbersOf(*this, attribute, 1).front(); }

Vec3 PluginElement::vector3(const std::string& attribute) const {
  const std::vector<double> v = numbersOf(*this, attribute, 3);
  return {v[0], v[1], v[2]};
}

bool PluginElement::boolean(const std::string& attribute) const {
  const std::string& value = text(attribute);
  return value == "true" || value == "1";
}

const std::string& PluginElement::text(const std::string& attribute) const {
  const auto found = attributes.find(attribute);
  if (found != attributes.end()) return found->second;
  throw std::logic_error("the manifest of plug-in '" + plugin + "' gives <" + element + "> no attribute '" + attribute +
                         "', which its library reads");
}

bool Scene::hasForceEffects() const {
  return std::ranges::any_of(plugin_elements,
                             [](const PluginElement& element) { return element.kind == PluginKind::kForceEffect; });
}

bool Scene::hasTools() const {
  return std::ranges::any_of(devices, [](const DeviceRole& device) { return device.tool.has_value(); });
}

bool Scene::hasFingertips() const {
  return std::ranges::any_of(devices, [](const DeviceRole& device) { return !device.tool.has_value(); });
}

namespace {

/// Calls visit(element, manifest, body, material) for each element that a plug-in brings, in the order of the document
/// within materials, haptics, and scene and bodies.
template <class Visit>
void forEachPluginElement(const xml::Element& root, const Visit& visit) {
  std::map<std::string, const Manifest*> manifest_of;  // by element
  for (const Manifest& manifest : manifests()) {
    for (const Manifest::Element& element : manifest.elements) manifest_of[element.name] = &manifest;
  }
  const auto add = [&](const xml::Element& element, std::int32_t body, std::int32_t material = -1) {
    const auto found = manifest_of.find(element.name());
    if (found != manifest_of.end()) visit(element, *found->second, body, material);
  };
  std::int32_t material = 0;
  for (const xml::Element& element : materialElements(root)) {
    for (const xml::Element& effect : element.children()) add(effect, kNoBody, material);
    for (const xml::Element& friction : element.children("friction")) {
      for (const xml::Element& law : friction.children()) add(law, kNoBody, material);
    }
    ++material;
  }
  for (const xml::Element& haptics : root.children("haptics")) {
    for (const xml::Element& settings : haptics.children()) add(settings, kNoBody);
  }
  std::int32_t body = 0;
  for (const xml::Element& child : root.children()) {
    add(child, kNoBody);
    if (child.name() != "body") continue;
    for (const xml::Element& inner : child.children()) add(inner, body);
    ++body;
  }
}

/// Names of the attributes of that type.
std::vector<std::string> attributesOf(const std::string& element, const std::string& type) {
  std::vector<std::string> names;
  const Manifest::Element* found = findElement(element);
  if (found == nullptr) return names;
  for (const Manifest::Attribute& attribute : found->attributes) {
    if (attribute.type == type) names.push_back(attribute.name);
  }
  return names;
}

}  // namespace

std::vector<PluginElement> readPluginElements(const xml::Element& root) {
  std::vector<PluginElement> all;
  forEachPluginElement(
      root, [&](const xml::Element& element, const Manifest& manifest, std::int32_t body, std::int32_t material) {
        PluginElement& added = all.emplace_back(
            PluginElement{manifest.name, element.name(), body, {}, element.where(), manifest.kind, material});
        for (const std::string& name : element.attributeNames()) added.attributes[name] = element.attribute(name);
      });
  return all;
}

void resolvePluginFiles(const xml::Element& root, const std::string& directory) {
  forEachPluginElement(root, [&](xml::Element element, const Manifest&, std::int32_t, std::int32_t) {
    for (const std::string& name : attributesOf(element.name(), "file"))
      element.setAttribute(name, resolvePath(element.attribute(name), directory));
  });
}

void forEachMaterialNamed(const xml::Element& root,
                          const std::function<void(const xml::Element&, const std::string&)>& visit) {
  forEachPluginElement(root, [&](const xml::Element& element, const Manifest&, std::int32_t, std::int32_t) {
    for (const std::string& name : attributesOf(element.name(), "material"))
      if (element.hasAttribute(name) && !element.flawed(name)) visit(element, name);
  });
}

std::vector<std::string> filesNamedBy(const PluginElement& element) {
  std::vector<std::string> files;
  for (const std::string& name : attributesOf(element.element, "file")) {
    const auto file = element.attributes.find(name);
    if (file != element.attributes.end() && !file->second.empty()) files.push_back(file->second);
  }
  return files;
}

}  // namespace presa
