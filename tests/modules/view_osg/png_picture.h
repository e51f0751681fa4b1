#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <osg/Image>
#include <osgDB/ReadFile>
#include <stdexcept>
#include <string>

#include "modules/view_osg/view_module.h"
#include "tests/modules/view_osg/pinch_world.h"

namespace presa::view_test {

/// An unused path in a folder of these tests.
inline std::string tempFile(const std::string& name) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "presa_view";
  std::filesystem::create_directories(folder);
  const std::string file = (folder / name).string();
  std::filesystem::remove(file);
  return file;
}

struct Color {
  int r, g, b;
};

class PngPicture {
 public:
  explicit PngPicture(const std::string& file) : image_(osgDB::readRefImageFile(file)) {
    if (!image_) throw std::runtime_error("no picture " + file);
  }
  int width() const { return image_->s(); }
  int height() const { return image_->t(); }
  /// x from the left, y from the top.
  Color at(int x, int y) const {
    const unsigned char* p = image_->data(x, image_->t() - 1 - y);
    return {p[0], p[1], p[2]};
  }

 private:
  osg::ref_ptr<osg::Image> image_;
};

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
