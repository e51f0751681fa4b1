#include "framework/haptics/plugin_object.h"

namespace presa {

std::string nameOf(const PluginElement& element, const Scene& scene) {
  std::size_t number = 0, count = 0;
  for (const PluginElement& other : scene.plugin_elements) {
    if (other.element != element.element || other.body != element.body || other.material != element.material) continue;
    ++count;
    if (&other == &element) number = count;
  }
  const std::string name =
      "<" + element.element + (count > 1 && number > 0 ? "[" + std::to_string(number) + "]" : "") + ">";
  if (element.body == kNoBody) return name;
  return name + " of body '" + scene.bodies[static_cast<std::size_t>(element.body)].name + "'";
}

double boundOf(const PluginElement& element, const std::string& attribute) {
  return element.attributes.contains(attribute) ? element.number(attribute) : 0;
}

}  // namespace presa
