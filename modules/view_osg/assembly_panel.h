#pragma once
#include <optional>
#include <osg/Group>
#include <string>

#include "framework/assembly/captions.h"
#include "modules/view_osg/hud_widgets.h"

namespace presa::view {

/// What people who put an assembly together are told: how far it is, what they hold and one sentence about it, why it must wait,
/// what comes next, and the finish. Coordinates: origin in the middle of a 720 lines high picture.
class AssemblyPanel {
 public:
  explicit AssemblyPanel(osg::Group& center);
  void update(const Scene& scene, const Guidance& guidance);

  static constexpr float kTop = -246;  ///< of what it covers at the lower edge

 private:
  void showLines(const Captions& captions);

  std::optional<Label> progress_, title_, sentence_, advice_, finish_, took_;
  std::optional<Bar> bar_;
  osg::ref_ptr<osg::Group> lines_ = new osg::Group, finish_group_ = new osg::Group;
};

}  // namespace presa::view
