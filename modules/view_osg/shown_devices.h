#pragma once
#include <memory>
#include <optional>
#include <osg/Group>
#include <vector>

#include "modules/view_osg/device_figures.h"
#include "modules/view_osg/device_panel.h"
#include "modules/view_osg/finger_view.h"

namespace presa::view {

/// The parts devices, compliance and heat of a picture: figures in the space, numbers at the right. Panels exist once they
/// are shown.
class ShownDevices {
 public:
  /// Null where no driver has a figure; nothing is loaded or made then. The groups must outlive this. `casters`: group of
  /// what casts shadows; `right`: group whose x = 0 is the right edge. Throws InputError.
  static std::unique_ptr<ShownDevices> of(const World& world, osg::Group& space, osg::Group& casters, osg::Group& right,
                                          const Ink& ink);

  void setQuick(bool quick);
  void follow(const ViewFrame& frame) { figures_->follow(frame); }
  /// `top`: upper edge of the panels.
  void show(const ShownParts& parts, const ViewFrame& frame, float top);
  /// A finger is without its pen in a device that is shown: the device shows how it is turned.
  void takePens(const ShownParts& parts, std::vector<FingerView>& fingers) const;
  /// Radius of a ball about this point that holds all of them [m].
  double reachFrom(const Vec3& center) const { return figures_->reachFrom(center); }
  void appendAppearance(std::vector<double>& appearance) const { figures_->appendAppearance(appearance); }

 private:
  ShownDevices(std::unique_ptr<DeviceFigures> figures, osg::Group& right, const Ink& ink);
  float showPanel(std::optional<DevicePanel>& panel, DevicePanel::Of what, bool shown, float top);

  std::unique_ptr<DeviceFigures> figures_;
  osg::ref_ptr<osg::Group> casters_ = new osg::Group;
  osg::Group& right_;
  const Ink ink_;
  std::optional<DevicePanel> deflections_, heats_;
};

}  // namespace presa::view
