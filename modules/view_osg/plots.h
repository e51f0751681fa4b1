#pragma once
#include <array>
#include <deque>
#include <osg/Geometry>
#include <osg/Group>
#include <osg/Timer>

#include "modules/view_osg/hud.h"

namespace presa::view {

/// Plots of the last seconds at the lower left: normal force and penetration of each finger, and the actual haptic
/// rate.
class Plots {
 public:
  static constexpr double kSeconds = 5;

  /// `left`: group whose x = 0 is the left edge.
  Plots(osg::Group& left, const World& world);
  /// Adds a sample; call in every step, drawn or not. A time before the last one, as in playback, restarts the plots.
  void add(const ViewFrame& frame, const GroupTimings& timings);
  void update(bool shown);

 private:
  enum Quantity : std::size_t { kForce, kDepth, kRate, kQuantities };
  struct Moment {
    double time;
    std::array<std::vector<double>, kQuantities> values;  ///< [N] and [mm] by finger, [Hz] (first entry only)
  };
  struct Panel {
    Label title, top;
    std::vector<osg::ref_ptr<osg::Geometry>> curves;
  };
  double haptic(const GroupTimings& timings);
  void draw(Quantity quantity);

  std::size_t fingers_;
  double nominal_rate_;
  std::deque<Moment> moments_;
  std::uint64_t ticks_ = 0;
  double rate_ = 0;
  osg::Timer_t counted_ = 0;
  osg::ref_ptr<osg::Group> group_ = new osg::Group;
  std::vector<Panel> panels_;
};

}  // namespace presa::view
