#pragma once
#include <osg/Group>
#include <osg/MatrixTransform>
#include <osg/Uniform>
#include <vector>

#include "modules/view_osg/finger_view.h"
#include "modules/view_osg/geometry_nodes.h"
#include "modules/view_osg/shown_parts.h"

namespace presa::view {

/// Colour of a contact state, linear RGB; also used in the head-up display.
Vec3 stateColor(ContactMode mode);
inline const Vec3 kHipColor{0.10, 0.85, 1.0};
inline const Vec3 kArrowColor{1.0, 0.72, 0.02};
inline const Vec3 kPenColor{0.16, 0.20, 0.30};
inline const Vec3 kSkinColor{0.80, 0.46, 0.34};
inline const Vec3 kToolColor{0.30, 0.42, 0.55};

/// Height and radius of the friction cone of a touching finger: as high as its normal force, so that the arrow's tip lies
/// within the rim until the contact slips [m].
struct ConeSize {
  double height, rim;
};
ConeSize coneSize(const FingerView& view);

/// Glyphs of the fingers: HIP, fingertip at the proxy with a pen where the device measures the orientation, or the tool
/// in its place, the link between them, force arrow, friction cone.
class ContactGlyphs {
 public:
  /// `world` must outlive it.
  explicit ContactGlyphs(const World& world);
  osg::Group* root() { return root_; }
  /// The fingertips, which cast shadows.
  osg::Node* casters() { return tips_; }
  /// Simplified for software rendering.
  void setQuick(bool quick);
  void update(const std::vector<FingerView>& fingers);
  void show(const ShownParts& parts);

 private:
  struct FingerGlyph {
    osg::ref_ptr<osg::MatrixTransform> hip, link, tip, pen, shaft, head, cone;
    osg::ref_ptr<osg::Uniform> tip_color, pressure, cone_color;
  };
  FingerGlyph makeFinger(const TriMesh* tool, const Roundness& round);
  void updateForce(const FingerView& view, FingerGlyph& finger);

  const World& world_;
  osg::ref_ptr<osg::Group> root_ = new osg::Group;
  osg::ref_ptr<osg::Group> solid_ = new osg::Group;  ///< HIPs and links
  osg::ref_ptr<osg::Group> arrows_ = new osg::Group;
  osg::ref_ptr<osg::Group> cones_ = new osg::Group;
  osg::ref_ptr<osg::Group> tips_ = new osg::Group;
  std::vector<FingerGlyph> fingers_;
};

}  // namespace presa::view
