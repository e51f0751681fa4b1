#include "tests/support/finger_world.h"

#include "framework/scene/manifest.h"
#include "framework/session/load_world.h"

namespace presa::test {
namespace {

bool standsInBody(const std::string& element) {
  const std::string name = element.substr(1, element.find_first_of(" />") - 1);
  const Manifest::Element* known = findElement(name);
  return known != nullptr && known->place == Manifest::Place::kBody;  // null: reading the scene reports it
}

}  // namespace

std::shared_ptr<const World> fingerWorld(const std::string& scene_xml) {
  Diagnostics diagnostics;
  const Loaded loaded =
      loadWithoutDevices({.scene_xml = scene_xml,
                          .name = "scene of a test",
                          .rig_xml = R"(<rig version="1.0" name="none"><device role="finger" driver="none"/></rig>)"},
                         {}, diagnostics);
  if (diagnostics.hasErrors()) throw InputError(std::move(diagnostics));
  return loaded.world;
}

std::shared_ptr<const World> elementWorld(const std::string& element, const std::string& gravity) {
  const bool in_body = standsInBody(element);
  const std::string scene = R"(<scene version="1.0" name="element">)" + (in_body ? "" : element) +
                            R"(<world gravity=")" + gravity +
                            R"("/><materials><material name="any" stiffness="1000"/></materials>
    <body name="cube" material="any">)" +
                            (in_body ? element : "") +
                            R"(<physics mass="0.2"><box size="0.07 0.07 0.07"/></physics></body>
    <devices><device role="finger" fingertip_radius="0.008"/></devices></scene>)";
  return fingerWorld(scene);
}

}  // namespace presa::test
