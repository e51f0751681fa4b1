#pragma once
#include <memory>
#include <optional>
#include <osg/Group>

#include "framework/scene/run_options.h"
#include "modules/view_osg/body_card.h"
#include "modules/view_osg/camera.h"
#include "modules/view_osg/change_watch.h"
#include "modules/view_osg/contact_glyphs.h"
#include "modules/view_osg/felt_relief.h"
#include "modules/view_osg/field_slice.h"
#include "modules/view_osg/finger_marks.h"
#include "modules/view_osg/frame_axes.h"
#include "modules/view_osg/grain.h"
#include "modules/view_osg/guides.h"
#include "modules/view_osg/hud.h"
#include "modules/view_osg/lighting.h"
#include "modules/view_osg/neighbourhood_lines.h"
#include "modules/view_osg/offset_panel.h"
#include "modules/view_osg/overlays.h"
#include "modules/view_osg/participant_panel.h"
#include "modules/view_osg/plots.h"
#include "modules/view_osg/scene_nodes.h"
#include "modules/view_osg/show_how.h"
#include "modules/view_osg/shown_devices.h"
#include "modules/view_osg/shown_joints.h"
#include "modules/view_osg/time_bar.h"
#include "modules/view_osg/tool_marks.h"
#include "modules/view_osg/visit_screen.h"

namespace presa::view {

/// The whole scene graph of a run: bodies, light, contact glyphs, head-up display. Independent of where it is shown.
class Picture {
 public:
  Picture(std::shared_ptr<const World> world, const RunOptions& options);
  osg::Group* root() { return root_; }
  /// The three-dimensional part; the rest is the head-up display's camera.
  osg::Group* space() { return space_; }
  Hud& hud() { return hud_; }
  TimeBar& timeBar() { return time_bar_; }
  /// The visible parts, from the next frame on.
  ShownParts& parts() { return parts_; }

  /// The help table in the visitors' language; empty: not for visitors.
  std::vector<std::pair<std::string, std::string>> visitorHelp() const { return view::visitorHelp(*world_); }

  /// Collects data for the plots. Call in every step, drawn or not.
  void follow(const ViewFrame& frame, const GroupTimings& timings) {
    if (parts_[ShownPart::kPlots]) plots_.add(frame, timings);
    if (parts_[ShownPart::kJoints]) joints_.follow(frame);
    if (devices_) devices_->follow(frame);
  }
  void show(const ViewFrame& frame, const GroupTimings& timings);
  /// What a participant sees from the next frame on; only in runs with RunOptions::participant.
  void setScreen(const ParticipantScreen& screen);
  const BodyNodes& bodies() const { return bodies_; }
  /// Simulated time of the frame [s].
  double time() const { return time_; }
  /// What differs from the frame before the last call.
  Changes takeChanges() { return watch_->take(); }
  /// Selects the body shown in the card; none hides it.
  void choose(std::optional<std::size_t> body) { card_.choose(body); }
  /// The balls that must be in the picture: free bodies (all bodies when none is free) and fingers.
  const std::vector<Ball>& subject() const { return subject_; }
  /// Argument of frameSubject: in an assembly task and without figures there are no cards at the sides.
  double usedWidth() const { return world_->scene.assembly || screen_ || !panels_ ? kWholeWidth : kBetweenCards; }
  /// Elevation of the camera, unless another is asked for [rad].
  double elevation() const { return isOutdoors(world_->scene) ? kEyeLevel : kElevation; }
  /// Height of the ground out of doors [m]; none: a floor that may be seen from below.
  std::optional<double> ground() const { return ground_; }
  /// For how long an assembly has been complete [s]; negative: it is not, or not for visitors.
  double finishedFor() const { return finished_for_; }
  /// The vertical axis of a walk round what was built goes through it.
  Vec3 middleOfGoals() const;
  /// The camera of the next frame.
  void seenFrom(const CameraPose& pose) {
    hud_.seenFrom(pose);
    joints_.seenFrom(pose);
    field_.seenFrom(pose);
    frame_axes_.seenFrom(pose);
  }
  /// Simplifies the picture for software rendering.
  void setQuick(bool quick);
  /// Size of the three-dimensional part [pixel].
  void setSize(int width, int height);
  /// Makes the space one of several pictures around an eye, for a root of its own: its colours depend on directions, and
  /// on no place in the picture.
  void surround(osg::Group& root);

 private:
  void prepareForVisitors(const RunOptions& options);
  ShownParts partsNow() const;
  bool changed(const ViewFrame& frame, const std::vector<FingerView>& fingers, const ShownParts& parts, double radius);
  void showOffsets(bool shown, const ViewFrame& frame);
  void updateSubject(const ViewFrame& frame, const std::vector<FingerView>& fingers);

  std::shared_ptr<const World> world_;
  osg::ref_ptr<osg::Group> root_ = new osg::Group, space_ = new osg::Group;
  BodyNodes bodies_;
  ContactGlyphs glyphs_;
  ShownParts parts_;
  Overlays overlays_;
  NeighbourhoodLines neighbourhoods_;
  FeltRelief relief_;
  std::unique_ptr<Guides> guides_;             // only in scenes with an assembly
  std::unique_ptr<FingerMarks> finger_marks_;  // only for visitors
  std::unique_ptr<ShowHow> show_how_;          // only for visitors with a mouse
  std::unique_ptr<ShownDevices> devices_;      // only with a driver that has a figure
  osg::ref_ptr<osg::Group> casters_ = new osg::Group, finger_casters_ = new osg::Group;
  osg::ref_ptr<osg::Node> background_;
  std::vector<osg::Node*> still_;  // parts of the space that do not move, and the bodies
  Lighting lighting_;
  Hud hud_;
  BodyCard card_;
  TimeBar time_bar_;
  Plots plots_;
  std::optional<OffsetPanel> offsets_;  // once it is shown
  ToolMarks tool_marks_;
  FieldSlice field_;
  ShownJoints joints_;
  FrameAxes frame_axes_;
  const Ink ink_;
  const bool panels_;       // something is drawn at the sides
  const bool whole_cones_;  // the camera keeps them in the picture
  const float offsets_top_;
  std::optional<ParticipantScreen> screen_;  // only for a participant
  std::optional<ParticipantPanel> panel_;    // with screen_
  std::vector<Ball> subject_;
  osg::ref_ptr<osg::Group> floor_ = new osg::Group;
  Vec3 floor_center_ = Vec3::Zero();
  double floor_radius_ = 0;
  bool quick_ = false;
  double time_ = 0, finished_for_ = -1;
  std::optional<double> ground_;
  std::optional<ChangeWatch> watch_;
  ShownParts drawn_parts_;
};

}  // namespace presa::view
