#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "modules/view_osg/view_module.h"
#include "tests/modules/view_osg/pinch_world.h"
#include "tests/support/png_picture.h"

namespace presa::view_test {

/// An unused path in a folder of these tests.
inline std::string tempFile(const std::string& name) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "presa_view";
  std::filesystem::create_directories(folder);
  const std::string file = (folder / (std::to_string(getpid()) + "_" + name)).string();  // tests run side by side
  std::filesystem::remove(file);
  return file;
}

using test::Color;
using test::PngPicture;

/// Runs an off-screen view for one tick and returns the outcome of the picture. `screen`: what a participant sees; null:
/// the picture is nobody's.
inline View::Screenshot drawOnce(const PinchRun& run, const PinchStates& states,
                                 const ParticipantScreen* screen = nullptr) {
  view::ViewModule module(run.world, run.options);
  Feed feed(module);
  module.start();
  if (screen != nullptr) module.setScreen(*screen);
  feed.publish(states, 0.5);
  module.step({30, 0.5, 1.0 / 60});
  module.stop();
  return module.screenshot();
}

}  // namespace presa::view_test
