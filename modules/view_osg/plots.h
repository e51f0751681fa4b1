#pragma once
#include <array>
#include <deque>
#include <osg/Geometry>
#include <osg/Group>
#include <osg/Timer>

#include "modules/view_osg/hud.h"

namespace presa::view {

/// The last seconds of normal force and penetration, finger by finger, and of the haptic rate that was reached, at the lower left.
class Plots {
 public:
  static constexpr double kSeconds = 5;

  /// `left`: x = 0 is the left edge.
  Plots(osg::Group& left, const World& world);
  /// Keeps this moment; every step, drawn or not. A moment before the last one, as in a recording, begins anew.
  void add(const ViewFrame& frame, const GroupTimings& timings);
  void update(bool shown);

 private:
  enum Quantity : std::size_t { kForce, kDepth, kRate, kQuantities };
  struct Moment {
    double time;
    std::array<std::array<double, kMaxFingers>, kQuantities> values;  ///< N, mm, Hz (the first alone)
  };
  struct Panel {
    Label title;
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
