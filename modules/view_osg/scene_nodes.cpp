#include "modules/view_osg/scene_nodes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <osg/ComputeBoundsVisitor>
#include <osg/CullFace>
#include <osg/Depth>
#include <osg/Geode>
#include <osgUtil/LineSegmentIntersector>

#include "framework/scene/physics_shapes.h"
#include "modules/view_osg/crease_normals.h"
#include "modules/view_osg/fewer_facets.h"
#include "modules/view_osg/geometry_nodes.h"
#include "modules/view_osg/grain.h"
#include "modules/view_osg/models/model_node.h"
#include "modules/view_osg/osg_convert.h"
#include "modules/view_osg/shaders.h"

namespace presa::view {
namespace {

constexpr double kCreaseAngle = 40 * std::numbers::pi / 180;
constexpr double kQuickTolerance = 0.0002;  ///< accuracy of surfaces for software rendering [m]
const Vec3 kFloorColor(0.20, 0.225, 0.26);

template <class... Ts>
struct Overload : Ts... {
  using Ts::operator()...;
};

/// The drawn shape of a body in its frame; null if none. `quick`: the haptic geometry if it has fewer facets.
osg::ref_ptr<osg::Node> makeShape(const World& world, std::size_t i, bool quick) {
  const Body& body = world.scene.bodies[i];
  const BodyMeshes meshes = i < world.meshes.size() ? world.meshes[i] : BodyMeshes{};
  const Geometry* shown = shownGeometry(body);
  if (shown == nullptr) return nullptr;
  if (std::holds_alternative<Compound>(shown->shape))
    return physicsNode(body, meshes, world.scene.materialOf(body).color, quick ? kQuick : kFine);
  if (body.visual && meshes.model) {
    osg::ref_ptr<osg::MatrixTransform> X_BG = new osg::MatrixTransform(toOsg(shown->X_BG));
    X_BG->addChild(modelNode(meshes.model, quick));
    return X_BG;
  }
  const TriMesh* mesh = shownMesh(body, meshes);
  if (quick && mesh != nullptr && meshes.haptic && meshes.haptic->triangles.size() < mesh->triangles.size()) {
    shown = &*body.haptic;
    mesh = meshes.haptic.get();
  }
  TriMesh fewer;
  if (quick && mesh != nullptr) {
    fewer = fewerFacets(*mesh, kQuickTolerance);
    mesh = &fewer;
  }
  const auto geometry = surfaceOf(shown->shape, mesh, world.scene.materialOf(body).color, quick ? kQuick : kFine);
  if (!geometry) return nullptr;
  osg::ref_ptr<osg::MatrixTransform> X_BG = new osg::MatrixTransform(toOsg(shown->X_BG));
  X_BG->addChild(geometry);
  return X_BG;
}

/// The fixed body with the texture earth, around which the floor continues; null if none.
const Body* earthOf(const Scene& scene) {
  const auto found = std::ranges::find_if(scene.bodies, [&](const Body& body) {
    return body.fixed && scene.materialOf(body).texture == Material::Texture::kEarth;
  });
  return found == scene.bodies.end() ? nullptr : &*found;
}

double topOf(const World& world, const Body& body) {
  osg::ComputeBoundsVisitor bounds;
  bounds.setNodeMaskOverride(~0U);
  BodyNodes bodies(world);
  bodies.root()->getChild(static_cast<unsigned>(&body - world.scene.bodies.data()))->accept(bounds);
  return bounds.getBoundingBox().zMax();
}

}  // namespace

const TriMesh* shownMesh(const Body& body, const BodyMeshes& meshes) {
  if (body.visual) return meshes.visual.get();
  if (body.haptic) return meshes.haptic.get();
  return meshes.physics.get();
}

osg::ref_ptr<osg::Geometry> surfaceOf(const Shape& shape, const TriMesh* mesh, const Vec3& color,
                                      const Roundness& round) {
  return std::visit(
      Overload{
          [&](const MeshRef&) {
            return mesh ? meshGeometry(shadeWithCreases(*mesh, kCreaseAngle), color) : osg::ref_ptr<osg::Geometry>();
          },
          [&](const Box& box) { return boxGeometry(box.size, color); },
          [&](const Sphere& sphere) { return sphereGeometry(sphere.radius, color, round); },
          [&](const Cylinder& cylinder) { return cylinderGeometry(cylinder.radius, cylinder.length, color, round); },
          [&](const Capsule& capsule) { return capsuleGeometry(capsule.radius, capsule.length, color, round); },
          [](const Compound&) { return osg::ref_ptr<osg::Geometry>(); }},
      shape);
}

osg::ref_ptr<osg::Group> physicsNode(const Body& body, const BodyMeshes& meshes, const Vec3& color,
                                     const Roundness& round) {
  osg::ref_ptr<osg::Group> group = new osg::Group;
  for (const PhysicsShape& shape : physicsShapes(body, meshes)) {
    const auto surface = surfaceOf(*shape.shape, shape.mesh, color, round);
    if (!surface) continue;
    osg::ref_ptr<osg::MatrixTransform> X_BG = new osg::MatrixTransform(toOsg(shape.X_BG));
    X_BG->addChild(surface);
    group->addChild(X_BG);
  }
  return group;
}

const Geometry* shownGeometry(const Body& body) {
  for (const auto* geometry : {&body.visual, &body.haptic, &body.physics})
    if (*geometry) return &**geometry;
  return nullptr;
}

BodyNodes::BodyNodes(const World& world) : world_(world) {
  root_->setName("bodies");
  const auto& bodies = world.scene.bodies;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Body& body = bodies[i];
    osg::ref_ptr<osg::MatrixTransform> X_WB = new osg::MatrixTransform(toOsg(body.X_WB));
    X_WB->setName(body.name);
    setGrain(*X_WB->getOrCreateStateSet(), i);
    if (&body == earthOf(world.scene)) X_WB->setNodeMask(0);  // replaced by the floor
    textures_.push_back(world.scene.materialOf(body).texture);
    const osg::ref_ptr<osg::Node> shape = makeShape(world, i, false);
    if (shape) X_WB->addChild(shape);
    const osg::BoundingSphere bound = shape ? shape->getBound() : osg::BoundingSphere();
    radius_.push_back(shape ? bound.center().length() + bound.radius() : 0);
    transforms_.push_back(X_WB);
    root_->addChild(X_WB);
  }
  setQuick(false);
}

void BodyNodes::setQuick(bool quick) {
  std::map<std::pair<Material::Texture, bool>, osg::ref_ptr<osg::Program>> programs;
  for (std::size_t i = 0; i < transforms_.size(); ++i) {
    osg::StateSet* state = transforms_[i]->getOrCreateStateSet();
    const bool grid = world_.scene.bodies[i].fixed && textures_[i] == Material::Texture::kNone;
    osg::ref_ptr<osg::Program>& program = programs[{textures_[i], grid}];
    if (!program) program = quick ? shaders::quickBody(textures_[i], grid) : shaders::body(textures_[i]);
    state->setAttributeAndModes(program);
    // fixed bodies are usually supports: a grid shows their scale
    state->getOrCreateUniform("grid_strength", osg::Uniform::FLOAT)->set(grid ? 1.0F : 0.0F);
    // stones are closed, so their back faces are never visible
    if (quick && textures_[i] != Material::Texture::kNone)
      state->setAttributeAndModes(new osg::CullFace(osg::CullFace::BACK));
    if (const osg::ref_ptr<osg::Node> shape = makeShape(world_, i, quick)) transforms_[i]->setChild(0, shape);
  }
}

void BodyNodes::setPoses(const std::vector<Pose>& X_WB) {
  for (std::size_t i = 0; i < transforms_.size() && i < X_WB.size(); ++i) transforms_[i]->setMatrix(toOsg(X_WB[i]));
}

double lowestPoint(const World& world) {
  BodyNodes bodies(world);
  osg::ComputeBoundsVisitor bounds;
  bodies.root()->accept(bounds);
  return bounds.getBoundingBox().valid() ? bounds.getBoundingBox().zMin() : 0.0;
}

double floorHeight(const World& world) {
  const Body* earth = earthOf(world.scene);
  return earth != nullptr ? topOf(world, *earth) : lowestPoint(world);
}

std::optional<BodyNodes::Hit> BodyNodes::along(const Vec3& eye, const Vec3& ray) const {
  constexpr double kFar = 1000;  // [m]
  const osg::ref_ptr<osgUtil::LineSegmentIntersector> line =
      new osgUtil::LineSegmentIntersector(toOsg(eye), toOsg(eye + kFar * ray));
  osgUtil::IntersectionVisitor visitor(line);
  root_->accept(visitor);
  if (!line->containsIntersections()) return std::nullopt;
  const auto& first = *line->getIntersections().begin();
  const osg::Vec3d p = first.getWorldIntersectPoint();
  for (const osg::Node* node : first.nodePath) {
    const auto body = std::find(transforms_.begin(), transforms_.end(), node);
    if (body != transforms_.end())
      return Hit{static_cast<std::size_t>(body - transforms_.begin()), {p.x(), p.y(), p.z()}};
  }
  return std::nullopt;
}

osg::ref_ptr<osg::Geometry> clipSpaceSheet(int rows, int columns) {
  osg::ref_ptr<osg::Geometry> sheet = new osg::Geometry;
  osg::ref_ptr<osg::Vec3Array> positions = new osg::Vec3Array;
  osg::ref_ptr<osg::Vec2Array> places = new osg::Vec2Array;
  for (int column = 0; column < columns; ++column) {
    const auto begin = static_cast<int>(positions->size());
    for (int row = 0; row <= rows; ++row) {
      const float up = static_cast<float>(row) / static_cast<float>(rows);
      for (const int edge : {column, column + 1}) {
        const float right = static_cast<float>(edge) / static_cast<float>(columns);
        places->push_back({right, up});
        positions->push_back({2 * right - 1, 2 * up - 1, 0});
      }
    }
    sheet->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLE_STRIP, begin, static_cast<int>(positions->size()) - begin));
  }
  sheet->setUseDisplayList(false);
  sheet->setUseVertexBufferObjects(true);
  sheet->setVertexArray(positions);
  sheet->setTexCoordArray(0, places);
  // positions are in clip space: without a bound it is not culled and does not move the near and far planes
  struct NoBound : osg::Drawable::ComputeBoundingBoxCallback {
    osg::BoundingBox computeBound(const osg::Drawable&) const override { return {}; }
  };
  sheet->setComputeBoundingBoxCallback(new NoBound);
  sheet->setCullingActive(false);
  return sheet;
}

osg::ref_ptr<osg::Node> makeBackground(int columns) {
  constexpr int kRows = 64;  // rows between which the sky's colour is nearly linear
  osg::ref_ptr<osg::Geometry> sky = clipSpaceSheet(kRows, columns);
  osg::StateSet* state = sky->getOrCreateStateSet();
  state->setAttributeAndModes(shaders::background());
  // drawn after everything that hides it, so that hidden pixels cost nothing
  state->setAttributeAndModes(new osg::Depth(osg::Depth::LEQUAL, 0, 1, false));
  state->setRenderBinDetails(6, "RenderBin");
  return sky;
}

osg::ref_ptr<osg::Node> makeFloor(const World& world, const Vec3& center, double radius, double shadows, bool quick) {
  const Body* earth = earthOf(world.scene);
  const double drop = earth != nullptr ? 0 : 1e-4;  // below bodies that end on the floor, against flicker
  const Vec3 middle(center.x(), center.y(), floorHeight(world) - drop);
  const Vec3 color = earth != nullptr ? world.scene.materialOf(*earth).color : kFloorColor;
  const Material::Texture texture = earth != nullptr ? Material::Texture::kEarth : Material::Texture::kNone;
  osg::ref_ptr<osg::MatrixTransform> floor =
      new osg::MatrixTransform(osg::Matrixd::translate(middle.x(), middle.y(), 0));
  floor->setName("floor");
  // with software rendering only the inner disc gets shadows
  const double shaded = quick ? std::min(shadows, radius) : radius;
  osg::ref_ptr<osg::Geometry> disc = revolve({{shaded, middle.z(), 0, 1}, {0, middle.z(), 0, 1}}, color);
  disc->getOrCreateStateSet()->setAttributeAndModes(quick ? shaders::quickFloor(texture, false)
                                                          : shaders::floor(texture));
  floor->addChild(disc);
  if (shaded < radius) {
    osg::ref_ptr<osg::Geometry> ring = revolve({{radius, middle.z(), 0, 1}, {shaded, middle.z(), 0, 1}}, color);
    ring->getOrCreateStateSet()->setAttributeAndModes(shaders::quickFloor(texture, true));
    floor->addChild(ring);
  }
  osg::StateSet* state = floor->getOrCreateStateSet();
  state->setRenderBinDetails(5, "RenderBin");
  state->addUniform(new osg::Uniform("floor_center", osg::Vec3(toOsg(middle))));
  state->addUniform(new osg::Uniform("floor_radius", static_cast<float>(radius)));
  return floor;
}

}  // namespace presa::view
