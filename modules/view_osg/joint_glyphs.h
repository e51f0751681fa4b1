#pragma once
#include <osg/Group>
#include <osg/MatrixTransform>
#include <vector>

#include "framework/scene/joints/joint_motion.h"
#include "modules/view_osg/scene_nodes.h"

namespace presa::view {

/// A glyph for each joint, drawn through the bodies that hide it. Violet stands in `to`, green moves with `body`.
/// Hinge: its axis with a disc, a hand, and the arc between its stops; slider: the line of its travel with stops and a
/// tick; ball: a sphere; universal: a cross of its two axes; fixed: a small block. Arcs and travels are to scale.
class JointGlyphs {
 public:
  /// `scene` as of the motions that update() gets.
  JointGlyphs(const Scene& scene, const JointMotion& motion, const BodyNodes& bodies);
  osg::Group* root() { return root_; }
  void update(const JointMotion& motion, const std::vector<Pose>& X_WB);

 private:
  struct Glyph {
    osg::ref_ptr<osg::MatrixTransform> X_WA, X_WB;  ///< J in `to` and in `body`
    osg::ref_ptr<osg::MatrixTransform> slid;        ///< J in `to`, moved along its axis to where `body` is
    osg::ref_ptr<osg::MatrixTransform> travel;      ///< unit shaft along z of J in `to`; null: it does not slide
    double size = 0;                                ///< [m]
  };
  void addTurning(const Joint& joint, std::size_t axis, const Pose& X_BJ, Glyph& glyph);
  void addSliding(const JointAxis& axis, Glyph& glyph);

  osg::ref_ptr<osg::Group> root_ = new osg::Group, solid_ = new osg::Group;
  std::vector<Glyph> glyphs_;
};

}  // namespace presa::view
