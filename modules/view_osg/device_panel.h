#pragma once
#include <osg/MatrixTransform>
#include <string>
#include <vector>

#include "modules/view_osg/device_figures.h"
#include "modules/view_osg/hud_widgets.h"
#include "modules/view_osg/ink.h"

namespace presa::view {

/// Numbers of the devices that have a figure, one row each: the deflection of the structure (with the factor by which it
/// is drawn), or the heat of the motors. At the right edge.
class DevicePanel {
 public:
  enum class Of { kDeflection, kHeat };
  /// `right`: group whose x = 0 is the right edge.
  DevicePanel(osg::Group& right, Of what, const std::vector<DeviceFigures::Told>& devices, const Ink& ink);
  void update(const std::vector<DeviceFigures::Told>& devices);
  void show(bool shown) { group_->setNodeMask(shown ? ~0U : 0U); }
  /// `top`: upper edge.
  void place(float top) { group_->setMatrix(osg::Matrixd::translate(0, top, 0)); }
  float height() const { return height_; }

 private:
  struct Value {
    Label number;
    Bar bar;
  };
  void addRow(const std::string& role, float top, std::size_t columns, const Ink& ink);

  const Of what_;
  float height_ = 0;
  osg::ref_ptr<osg::MatrixTransform> group_ = new osg::MatrixTransform;
  std::vector<std::vector<Value>> rows_;
};

}  // namespace presa::view
