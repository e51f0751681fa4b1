#include "apps/presa/gallery/mouse_rig.h"

#include <algorithm>

#include "framework/scene/xml/escaped.h"

namespace presa::gallery {
namespace {

std::string setting(const std::string& key, const std::string& value) {
  return "<set key=\"" + xml::escaped(key) + "\" value=\"" + xml::escaped(value) + "\"/>";
}

std::string device(const std::string& role, const std::string& driver, const std::string& settings) {
  return "  <device role=\"" + xml::escaped(role) + "\" driver=\"" + xml::escaped(driver) + "\">" + settings +
         "</device>\n";
}

std::string kept(const DeviceBinding& binding) {
  std::string settings;
  for (const auto& [key, value] : binding.settings) settings += setting(key, value.value);
  return device(binding.role, binding.driver, settings);
}

}  // namespace

std::string mouseRig(const Scene& scene, const Rig& own) {
  bool thumb = false, index = false;  // moved already
  std::string devices;
  for (const DeviceRole& role : scene.devices) {
    if (role.role == "stylus") {
      devices += device(role.role, "pointer", setting("tool", "stylus"));
      continue;
    }
    const bool is_thumb = role.role.ends_with("thumb");
    if (bool& moved = is_thumb ? thumb : index; !moved) {
      moved = true;
      devices += device(role.role, "pointer", setting("side", is_thumb ? "-1" : "1"));
      continue;
    }
    const auto binding = std::ranges::find(own.devices, role.role, &DeviceBinding::role);
    if (binding != own.devices.end()) devices += kept(*binding);
  }
  return "<rig version=\"1.0\" name=\"mouse\">\n" + devices + "</rig>\n";
}

}  // namespace presa::gallery
