#pragma once
#include <optional>
#include <osg/Group>
#include <osg/MatrixTransform>
#include <vector>

#include "framework/scene/world.h"
#include "modules/view_osg/geometry_nodes.h"

namespace presa::view {

/// The bodies of the scene, each under one transform.
class BodyNodes {
 public:
  /// `world` must outlive this.
  explicit BodyNodes(const World& world);
  osg::Group* root() { return root_; }
  /// Simplified shapes for software rendering.
  void setQuick(bool quick);
  /// Poses in the order of Scene::bodies.
  void setPoses(const std::vector<Pose>& X_WB);
  std::size_t count() const { return transforms_.size(); }
  /// The drawn shape of a body in its frame; null if none. It may be used in other places, too.
  osg::Node* shape(std::size_t body) {
    return transforms_[body]->getNumChildren() > 0 ? transforms_[body]->getChild(0) : nullptr;
  }
  /// The first body along a ray, and the point where the ray meets its surface.
  struct Hit {
    std::size_t body;
    Vec3 p_W;
  };
  std::optional<Hit> along(const Vec3& eye, const Vec3& ray) const;
  void show(bool shown) { root_->setNodeMask(shown ? ~0U : 0U); }
  /// Radius of the drawn shape about the body's origin [m].
  double radius(std::size_t body) const { return radius_[body]; }

 private:
  const World& world_;
  osg::ref_ptr<osg::Group> root_ = new osg::Group;
  std::vector<osg::ref_ptr<osg::MatrixTransform>> transforms_;
  std::vector<Material::Texture> textures_;
  std::vector<double> radius_;
};

/// The geometry that represents a body: visual, else haptic, else physics; null if it has none.
const Geometry* shownGeometry(const Body& body);

/// The mesh of that geometry, or null.
const TriMesh* shownMesh(const Body& body, const BodyMeshes& meshes);

/// A shape in its own frame; null for a missing mesh.
osg::ref_ptr<osg::Geometry> surfaceOf(const Shape& shape, const TriMesh* mesh, const Vec3& color,
                                      const Roundness& round = kFine);

/// All shapes of a body's physics geometry, in the body frame.
osg::ref_ptr<osg::Group> physicsNode(const Body& body, const BodyMeshes& meshes, const Vec3& color,
                                     const Roundness& round = kFine);

/// Height of the floor of a scene without earth, and the lowest point of its drawn bodies at the start [m].
double lowestPoint(const World& world);

/// Height of the floor, with or without earth [m].
double floorHeight(const World& world);

/// A rectangle over the whole picture, from (-1, -1) to (1, 1), for shaders with positions in clip space; texture
/// coordinates from 0 to 1. `rows`, `columns`: number of subdivisions in height and width.
osg::ref_ptr<osg::Geometry> clipSpaceSheet(int rows, int columns = 1);

/// Gradient behind everything. Its colours are linear between `columns`, too: 1 for a camera that stands upright.
osg::ref_ptr<osg::Node> makeBackground(int columns = 1);

/// Floor with a grid under the lowest body at its start pose, fading into the background. Shadows fall within `shadows`
/// of its middle [m].
osg::ref_ptr<osg::Node> makeFloor(const World& world, const Vec3& center, double radius, double shadows, bool quick);

}  // namespace presa::view
