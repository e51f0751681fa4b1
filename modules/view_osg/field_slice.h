#pragma once
#include <optional>
#include <osg/Geometry>
#include <osg/Image>
#include <osg/MatrixTransform>
#include <vector>

#include "modules/view_osg/camera.h"
#include "modules/view_osg/finger_view.h"
#include "modules/view_osg/ink.h"
#include "modules/view_osg/slice_plane.h"

namespace presa::view {

/// `--show field`: signed distances of the bodies as the renderer of tools looks them up, on a plane through each tool that
/// faces the camera, over everything else, with the outline of the tool. Blue outside, orange inside, a line each few
/// tenths of the scale, which stands at the lower left. The fields are looked for when first shown.
class FieldSlice {
 public:
  /// All must outlive this. `left`: group of the display whose x = 0 is the left edge.
  FieldSlice(const World& world, osg::Group& space, osg::Group& left, const Ink& ink)
      : world_(world), space_(space), left_(left), ink_(ink) {}
  /// Throws InputError: the errors of toolFieldsOf.
  void show(bool shown, const ViewFrame& frame, const std::vector<FingerView>& fingers);
  /// The camera of the next picture.
  void seenFrom(const CameraPose& pose);
  /// Appends what its colours depend on.
  void appendAppearance(std::vector<double>& appearance) const;

 private:
  struct Slice {
    std::size_t tool;  // device role
    AxisBox box_T;
    osg::ref_ptr<osg::MatrixTransform> place;
    osg::ref_ptr<osg::Geometry> sheet = new osg::Geometry, outline = new osg::Geometry;
    osg::ref_ptr<osg::Image> values = new osg::Image;
    Pose X_WT;
    bool alive = false;
  };
  void load();
  void chooseScale();
  void makeSheet(Slice& slice) const;
  void draw(Slice& slice) const;
  void addScale();

  const World& world_;
  osg::Group& space_;
  osg::Group& left_;
  const Ink ink_;
  bool loaded_ = false, shown_ = false;
  std::vector<ToolField> fields_;
  std::vector<double> radius_;      // of a ball about each body's origin [m]
  std::vector<Slice> slices_;       // one a tool
  double range_ = 0, step_ = 0;     // of the colours; between lines [m]
  std::optional<Vec3> eye_;         // none: no picture yet
  std::vector<Pose> X_WB_;          // of the frame that is shown
  osg::ref_ptr<osg::Group> scale_;  // null: never shown
};

}  // namespace presa::view
