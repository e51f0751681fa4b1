#pragma once
#include <optional>
#include <osg/Group>
#include <osg/MatrixTransform>
#include <vector>

#include "framework/scene/world.h"

namespace presa::view {

/// The bodies of the scene, each under one transform, and the still things around them.
class BodyNodes {
 public:
  /// `world` must outlive this.
  explicit BodyNodes(const World& world);
  osg::Group* root() { return root_; }
  /// For a processor that draws.
  void setQuick(bool quick);
  /// Poses as Scene::bodies.
  void setPoses(const std::vector<Pose>& X_WB);
  /// What is drawn of it, in the body's frame; null when there is nothing. It may hang in other places, too.
  osg::Node* shape(std::size_t body) {
    return transforms_[body]->getNumChildren() > 0 ? transforms_[body]->getChild(0) : nullptr;
  }
  /// The body that is first along a ray, and where it meets its surface.
  struct Hit {
    std::size_t body;
    Vec3 p_W;
  };
  std::optional<Hit> along(const Vec3& eye, const Vec3& ray) const;
  void show(bool shown) { root_->setNodeMask(shown ? ~0U : 0U); }
  /// Smallest sphere about the body's origin that holds what is drawn of it [m].
  double radius(std::size_t body) const { return radius_[body]; }

 private:
  const World& world_;
  osg::ref_ptr<osg::Group> root_ = new osg::Group;
  std::vector<osg::ref_ptr<osg::MatrixTransform>> transforms_;
  std::vector<Material::Texture> textures_;
  std::vector<double> radius_;
};

/// The geometry that shows a body: visual, else haptic, else physics; null when it has none.
const Geometry* shownGeometry(const Body& body);

/// Its mesh, where that geometry has one.
const TriMesh* shownMesh(const Body& body, const BodyMeshes& meshes);

/// A shape in its own frame; null for a mesh that is not there.
osg::ref_ptr<osg::Geometry> surfaceOf(const Shape& shape, const TriMesh* mesh, const Vec3& color);

/// The whole picture, from (-1, -1) to (1, 1), for shaders that take positions in clip space; texture coordinates from 0 to 1. `rows`: one
/// above the other.
osg::ref_ptr<osg::Geometry> clipSpaceSheet(int rows);

/// Gradient behind everything.
osg::ref_ptr<osg::Node> makeBackground();

/// Ground with a grid, under the lowest body at its start pose, fading into the background. Shadows fall within `shadows` of its middle [m].
osg::ref_ptr<osg::Node> makeFloor(const World& world, const Vec3& center, double radius, double shadows, bool quick);

}  // namespace presa::view
