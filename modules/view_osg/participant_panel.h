#pragma once
#include <osg/Group>
#include <string>
#include <vector>

#include "framework/scene/participant_screen.h"
#include "modules/view_osg/hud_widgets.h"

namespace presa::view {

/// Text, fixation cross and black ground of a participant's picture, in the coordinates of the head-up display with their
/// origin in the middle.
class ParticipantPanel {
 public:
  explicit ParticipantPanel(osg::Group& center);
  void show(const ParticipantScreen& screen);

 private:
  osg::ref_ptr<osg::Group> ground_ = new osg::Group, cross_ = new osg::Group, card_ = new osg::Group;
  std::vector<Label> lines_;
};

/// `text` in lines of at most `columns` characters, broken between words and where it has a line break. A longer word has a
/// line of its own.
std::vector<std::string> wrapped(const std::string& text, std::size_t columns);

}  // namespace presa::view
