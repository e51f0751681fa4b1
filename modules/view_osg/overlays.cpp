#include "modules/view_osg/overlays.h"

#include <osg/LineWidth>
#include <osg/PolygonMode>

#include "framework/scene/physics_shapes.h"
#include "modules/view_osg/frame_axes.h"
#include "modules/view_osg/geometry_nodes.h"
#include "modules/view_osg/osg_convert.h"
#include "modules/view_osg/scene_nodes.h"
#include "modules/view_osg/shaders.h"

namespace presa::view {
namespace {

const Vec3 kHapticColor(0.05, 0.75, 1.0), kPhysicsColor(1.0, 0.15, 0.75), kSleepColor(0.35, 0.45, 1.0);
constexpr double kAxisLength = 1.25;  ///< relative to the drawn size of the body
constexpr double kWorldAxis = 0.1;    ///< [m]

/// The shape of a body in one layer, in the body's frame; null: nothing.
osg::ref_ptr<osg::Node> linesOf(ShownPart part, const Body& body, const BodyMeshes& meshes) {
  const bool haptic = part == ShownPart::kHaptic, physics = part == ShownPart::kPhysics;
  const auto& geometry = haptic ? body.haptic : physics ? body.physics : body.visual;
  const Geometry* shape = haptic || physics ? (geometry ? &*geometry : nullptr) : shownGeometry(body);
  if (shape == nullptr) return nullptr;
  if ((physics && hasSeveralShapes(body, meshes)) || std::holds_alternative<Compound>(shape->shape))
    return physicsNode(body, meshes, physics ? kPhysicsColor : kSleepColor);
  const TriMesh* mesh = haptic ? meshes.haptic.get() : physics ? meshes.physics.get() : shownMesh(body, meshes);
  const Vec3& color = haptic ? kHapticColor : physics ? kPhysicsColor : kSleepColor;
  const auto surface = surfaceOf(shape->shape, mesh, color);
  if (!surface) return nullptr;
  osg::ref_ptr<osg::MatrixTransform> X_BG = new osg::MatrixTransform(toOsg(shape->X_BG));
  X_BG->addChild(surface);
  return X_BG;
}

bool isLines(ShownPart part) { return part != ShownPart::kFrames; }

}  // namespace

Overlays::Layer Overlays::make(ShownPart part) const {
  Layer layer;
  layer.group = new osg::Group;
  osg::StateSet* state = layer.group->getOrCreateStateSet();
  state->setAttributeAndModes(shaders::glyph());
  state->addUniform(new osg::Uniform("opacity", 1.0F));
  if (isLines(part)) {
    state->setAttributeAndModes(new osg::PolygonMode(osg::PolygonMode::FRONT_AND_BACK, osg::PolygonMode::LINE));
    state->setAttributeAndModes(new osg::LineWidth(1.5F));
  } else {
    layer.group->addChild(axisCross(kWorldAxis));
  }
  const auto& bodies = world_.scene.bodies;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    osg::ref_ptr<osg::MatrixTransform> X_WB = new osg::MatrixTransform;
    if (isLines(part)) {
      const BodyMeshes meshes = i < world_.meshes.size() ? world_.meshes[i] : BodyMeshes{};
      if (const auto lines = linesOf(part, bodies[i], meshes)) X_WB->addChild(lines);
    } else if (!bodies[i].fixed) {
      const auto surface =
          linesOf(ShownPart::kSleeping, bodies[i], i < world_.meshes.size() ? world_.meshes[i] : BodyMeshes{});
      if (surface) X_WB->addChild(axisCross(kAxisLength * surface->getBound().radius()));
    }
    layer.bodies.push_back(X_WB);
    layer.group->addChild(X_WB);
  }
  return layer;
}

void Overlays::update(const ShownParts& parts, const std::vector<Pose>& X_WB, const std::vector<bool>& asleep) {
  for (const ShownPart part : {ShownPart::kHaptic, ShownPart::kPhysics, ShownPart::kSleeping, ShownPart::kFrames}) {
    Layer& layer = layers_[static_cast<std::size_t>(part)];
    if (layer.group) layer.group->setNodeMask(parts[part] ? ~0U : 0U);
    if (!parts[part]) continue;
    if (!layer.group) {
      layer = make(part);
      root_->addChild(layer.group);
    }
    for (std::size_t i = 0; i < layer.bodies.size() && i < X_WB.size(); ++i) {
      layer.bodies[i]->setMatrix(toOsg(X_WB[i]));
      if (part == ShownPart::kSleeping) layer.bodies[i]->setNodeMask(i < asleep.size() && asleep[i] ? ~0U : 0U);
    }
  }
}

}  // namespace presa::view
