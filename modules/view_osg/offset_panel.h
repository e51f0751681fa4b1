#pragma once
#include <array>
#include <osg/Group>
#include <vector>

#include "modules/view_osg/finger_view.h"
#include "modules/view_osg/hud_widgets.h"
#include "modules/view_osg/ink.h"

namespace presa::view {

/// Offsets of one finger while it touches a body, split along the contact's normal (positive away from the body) and
/// across it [m].
struct FingerOffset {
  double normal = 0, tangential = 0;
};
/// Proxy minus HIP: what stretches the contact's spring. R_WB: of the touched body (the bus sends no nhat_W).
FingerOffset offsetFromHip(const FingerContact& contact, const Quat& R_WB);
/// Proxy minus the object's origin, turned with the object: constant while the finger sticks, the measure of grasping.
FingerOffset offsetFromObject(const FingerContact& contact);

/// These offsets of each finger as numbers [mm] and bars, at the right below the rates.
class OffsetPanel {
 public:
  static constexpr double kHipBar = 0.010, kObjectBar = 0.100;  ///< offsets of a full bar [m]

  /// `right`: group whose x = 0 is the right edge; `top`: upper edge of the panel.
  OffsetPanel(osg::Group& right, float top, const World& world, const Ink& ink);
  /// [lines]
  static float heightFor(const World& world);
  void update(const ViewFrame& frame);
  void show(bool shown) { group_->setNodeMask(shown ? ~0U : 0U); }

 private:
  struct Value {
    Label number;
    Bar bar;
    double full;  ///< [m]
  };
  void addFinger(const std::string& role, float top, const Ink& ink);
  static void set(Value& value, bool touches, double offset, ContactMode mode);

  osg::ref_ptr<osg::Group> group_ = new osg::Group;
  std::vector<std::array<Value, 4>> fingers_;  ///< HIP tangential and normal, object tangential and normal
};

}  // namespace presa::view
