#pragma once
#include <array>
#include <optional>
#include <osg/Group>

#include "framework/scene/world.h"
#include "modules/view_osg/hud_widgets.h"

namespace presa::view {

/// Card of the selected body in the head-up display: name, mass, material, pose. Lower right.
class BodyCard {
 public:
  /// `right`: group whose x = 0 is the right edge.
  BodyCard(osg::Group& right, const World& world);
  /// Selects a body; none hides the card.
  void choose(std::optional<std::size_t> body);
  /// Poses in the order of Scene::bodies.
  void update(const std::vector<Pose>& X_WB);

 private:
  const World& world_;
  std::optional<std::size_t> body_;
  osg::ref_ptr<osg::Group> card_ = new osg::Group;
  std::optional<Label> name_, what_, place_, turn_;
};

}  // namespace presa::view
