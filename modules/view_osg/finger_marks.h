#pragma once
#include <memory>
#include <optional>
#include <osg/Group>
#include <osg/MatrixTransform>
#include <osg/Uniform>
#include <vector>

#include "framework/geometry/surface_tree.h"
#include "framework/scene/world.h"
#include "modules/view_osg/finger_view.h"

namespace presa::view {

/// What lies around a point of the scene, by the surfaces that fingers feel. Frame W. Thread: view.
class Surroundings {
 public:
  /// `world` must outlive this.
  explicit Surroundings(const World& world);

  /// Height of the first surface below p; none without one.
  std::optional<double> below(const Vec3& p_W, const std::vector<Pose>& X_WB) const;
  struct Near {
    Vec3 p_W;         ///< point of the nearest free body's surface
    Vec3 nhat_W;      ///< unit, from there to the point that was asked about
    double distance;  ///< [m]
  };
  /// The nearest point of a free body within `reach`; none without one, or from inside of it.
  std::optional<Near> nearest(const Vec3& p_W, double reach, const std::vector<Pose>& X_WB) const;

 private:
  const World& world_;
  std::vector<std::unique_ptr<SurfaceTree>> trees_;  ///< by body; null: not a mesh
};

/// Marks that let a visitor see where the fingertips are: opaque, bright fingers, a line from each fingertip down to
/// what lies below it, with a spot there like a shadow at noon, and a glow where the fingertip would touch.
class FingerMarks {
 public:
  FingerMarks(const World& world, std::size_t fingers);
  osg::Group* root() { return root_; }
  /// The fingers, which cast shadows.
  osg::Node* casters() { return solid_; }
  void update(const std::vector<FingerView>& fingers, const std::vector<Pose>& X_WB);

  static constexpr double kGlowReach = 0.05;  ///< distance of the surface at which the glow begins [m]

 private:
  struct Marks {
    osg::ref_ptr<osg::MatrixTransform> tip, finger, end, line, spot, ring, glow;
    osg::ref_ptr<osg::Uniform> glow_opacity;
  };
  Marks make(std::size_t finger);
  void follow(const FingerView& view, const Vec3& towards_W, const std::vector<Pose>& X_WB, Marks& marks);

  Surroundings around_;
  osg::ref_ptr<osg::Group> root_ = new osg::Group, solid_ = new osg::Group, faint_ = new osg::Group;
  std::vector<Marks> marks_;
};

}  // namespace presa::view
