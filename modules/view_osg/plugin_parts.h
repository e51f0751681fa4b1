#pragma once
#include <memory>
#include <osg/Geometry>
#include <string>
#include <vector>

#include "framework/scene/world.h"
#include "framework/session/view_part.h"
#include "modules/view_osg/view_frame.h"

namespace presa::view {

/// The parts of the picture that plug-ins draw, as lines.
class PluginParts {
 public:
  /// Loads the plug-ins that the scene names. Null without one. Throws InputError (E596).
  static std::unique_ptr<PluginParts> of(std::shared_ptr<const World> world);

  osg::Node* root() { return lines_; }
  void follow(const ViewFrame& frame);
  void draw(const ViewFrame& frame);
  std::vector<std::string> what() const;

 private:
  PluginParts();
  std::shared_ptr<const World> world_;
  std::vector<std::unique_ptr<ViewPart>> parts_;
  osg::ref_ptr<osg::Geometry> lines_ = new osg::Geometry;
};

}  // namespace presa::view
