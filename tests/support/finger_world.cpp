#include "tests/support/finger_world.h"

#include "framework/session/load_world.h"

namespace presa::test {

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

}  // namespace presa::test
