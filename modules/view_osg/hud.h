#pragma once
#include <array>
#include <memory>
#include <optional>
#include <osg/Camera>
#include <osg/MatrixTransform>
#include <vector>

#include "framework/core/schedule/tick.h"
#include "framework/core/schedule/timing_stats.h"
#include "framework/scene/run_options.h"
#include "modules/view_osg/assembly_panel.h"
#include "modules/view_osg/finger_view.h"
#include "modules/view_osg/hud_widgets.h"
#include "modules/view_osg/ink.h"
#include "modules/view_osg/scale_bar.h"
#include "modules/view_osg/scene_menu.h"

namespace presa::view {

using GroupTimings = std::array<const GroupTiming*, kRateGroupCount>;

/// Head-up display: scene and time, one card per finger, grip force, rates, legend, help on demand.
class Hud {
 public:
  static constexpr float kHeight = 720;  ///< height of its coordinate system [lines]

  Hud(const World& world, const RunOptions& options);
  osg::Camera* camera() { return camera_; }
  /// Groups for additional cards: x = 0 at the left edge, at the right edge, and origin in the middle.
  osg::Group& left() { return *left_; }
  osg::Group& right() { return *right_; }
  osg::MatrixTransform& center() { return *center_; }
  /// A group with its origin in the middle that stays when the figures are hidden.
  osg::Group& participantCenter() { return *participant_; }
  void showFigures(bool shown);
  void update(const ViewFrame& frame, const std::vector<FingerView>& fingers, const GroupTimings& timings);
  /// Sets width over height of the picture; items at the right edge move with it.
  void setAspect(double aspect);
  /// The lines shown by `toggleHelp`: keys (empty: a heading) and their function.
  void setHelp(const std::vector<std::pair<std::string, std::string>>& lines);
  void toggleHelp();
  /// Adds the menu of scenes, closed.
  void offerScenes(const std::vector<OfferedScene>& scenes, std::size_t now);
  SceneMenu* menu() { return menu_ ? &*menu_ : nullptr; }
  /// Shows a line at the top, until the next call.
  void setBanner(const std::string& text, bool alarm);
  /// Moves the scale bar, where there is one.
  void seenFrom(const CameraPose& pose);
  /// Shows a line above the legend, until the next call; on the terminal where the display is off.
  void tell(const std::string& message);

 private:
  struct Card {
    Label role, state, forces, use;
    Bar bar;
    osg::ref_ptr<osg::Geometry> lamp;
  };
  struct RateLine {
    RateGroup group;
    double nominal;
    Label rate, missed;
  };
  using Level = PictureOptions::Hud;
  void reduce();
  void addTitle(const World& world);
  void addSentence(const std::string& sentence);
  void addCard(std::size_t index);
  void addGrip();
  void addRates(const World& world, bool bus);
  void addLegend(bool interactive);
  void updateCard(Card& card, const FingerView& finger);
  void updateRates(const GroupTimings& timings);

  osg::ref_ptr<osg::Camera> camera_ = new osg::Camera;
  osg::ref_ptr<osg::Group> content_ = new osg::Group;
  osg::ref_ptr<osg::Group> left_ = new osg::Group;
  osg::ref_ptr<osg::MatrixTransform> right_ = new osg::MatrixTransform;        ///< x = 0 is the right edge
  osg::ref_ptr<osg::Node> banner_panel_;                                       ///< behind the banner of an assembly
  osg::ref_ptr<osg::MatrixTransform> center_ = new osg::MatrixTransform;       ///< origin in the middle
  osg::ref_ptr<osg::MatrixTransform> participant_ = new osg::MatrixTransform;  ///< origin in the middle
  osg::ref_ptr<osg::Group> figures_ = new osg::Group;                          ///< all but `participant_`
  osg::ref_ptr<osg::Group> help_ = new osg::Group;
  /// In an assembly task, rates and fingers are shown only with the help, and the legend gives way to the assembly
  /// panel.
  osg::ref_ptr<osg::Group> right_figures_ = new osg::Group, left_figures_ = new osg::Group;
  osg::ref_ptr<osg::MatrixTransform> legend_ = new osg::MatrixTransform, sentence_ = new osg::MatrixTransform;
  osg::ref_ptr<osg::Group> title_ = new osg::Group, task_ = new osg::Group, notes_ = new osg::Group;
  const World& world_;
  const Level level_;
  const Ink ink_;
  const bool plain_;  ///< for visitors: no figures, not even with the help
  std::optional<AssemblyPanel> assembly_;
  std::optional<Label> time_, banner_, output_, grip_value_, message_;
  std::optional<Bar> grip_bar_;
  std::optional<ScaleBar> scale_bar_;
  std::optional<SceneMenu> menu_;
  std::vector<Card> cards_;
  std::vector<RateLine> rates_;
  float legend_width_ = 0, sentence_width_ = 0;
  double grip_scale_ = 0;  ///< full bar: the most that the devices can give [N]
};

}  // namespace presa::view
