#pragma once
#include <optional>
#include <osg/Group>
#include <string>

#include "framework/assembly/captions.h"
#include "modules/view_osg/hud_widgets.h"

namespace presa::view {

/// Texts for the user of an assembly: progress, the held body with one sentence about it, the reason why it must wait,
/// the next step, and the end. Coordinates: origin in the middle of a picture 720 lines high.
class AssemblyPanel {
 public:
  explicit AssemblyPanel(osg::Group& center);
  void update(const Scene& scene, const Guidance& guidance);

  static constexpr float kTop = -246;  ///< upper edge of the area covered at the bottom

 private:
  void showLines(const Captions& captions);

  std::optional<Label> progress_, title_, sentence_, advice_, finish_, took_;
  std::optional<Bar> bar_;
  osg::ref_ptr<osg::Group> lines_ = new osg::Group, finish_group_ = new osg::Group;
};

}  // namespace presa::view
