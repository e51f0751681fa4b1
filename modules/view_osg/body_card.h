#pragma once
#include <array>
#include <optional>
#include <osg/Group>

#include "framework/scene/world.h"
#include "modules/view_osg/hud_widgets.h"

namespace presa::view {

/// What the head-up display says of the body that was clicked: name, mass, material, pose. Lower right.
class BodyCard {
 public:
  /// `right`: x = 0 is the right edge.
  BodyCard(osg::Group& right, const World& world);
  /// None: the card goes.
  void choose(std::optional<std::size_t> body);
  /// Poses as Scene::bodies.
  void update(const std::vector<Pose>& X_WB);

 private:
  const World& world_;
  std::optional<std::size_t> body_;
  osg::ref_ptr<osg::Group> card_ = new osg::Group;
  std::optional<Label> name_, what_, place_, turn_;
};

}  // namespace presa::view
