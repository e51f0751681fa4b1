#include "modules/view_osg/neighbourhood_lines.h"

#include <osg/LineWidth>

#include "modules/view_osg/osg_convert.h"
#include "modules/view_osg/shaders.h"

namespace presa::view {
namespace {

constexpr double kAroundFinger = 0.015;      ///< radius around a finger [m]
constexpr std::size_t kMaxCorners = 30'000;  ///< 5000 triangles
constexpr double kLift = 2e-4;               ///< distance from the surface, against flicker [m]

}  // namespace

NeighbourhoodLines::NeighbourhoodLines(const World& world) : world_(world) {
  lines_->setName("patches");
  lines_->setDataVariance(osg::Object::DYNAMIC);
  lines_->setUseDisplayList(false);
  lines_->setUseVertexBufferObjects(true);
  osg::ref_ptr<osg::Vec4Array> color = new osg::Vec4Array(osg::Array::BIND_OVERALL);
  color->push_back({1.0F, 0.85F, 0.1F, 1.0F});
  lines_->setColorArray(color);
  osg::StateSet* state = lines_->getOrCreateStateSet();
  state->setAttributeAndModes(shaders::glyph());
  state->addUniform(new osg::Uniform("opacity", 1.0F));
  state->setAttributeAndModes(new osg::LineWidth(1.5F));
  lines_->setNodeMask(0);
}

void NeighbourhoodLines::update(bool shown, const FingerNeighbourhoods* neighbourhoods, const std::vector<Pose>& X_WB) {
  shown = shown && neighbourhoods != nullptr;
  lines_->setNodeMask(shown ? ~0U : 0U);
  if (!shown) return;
  osg::ref_ptr<osg::Vec3Array> corners = new osg::Vec3Array, normals = new osg::Vec3Array(osg::Array::BIND_PER_VERTEX);
  for (std::size_t n = 0; n < static_cast<std::size_t>(neighbourhoods->count); ++n) {
    const FingerNeighbourhood& finger = neighbourhoods->fingers[n];
    for (std::size_t b = 0; b < static_cast<std::size_t>(finger.body_count); ++b) {
      const auto body = static_cast<std::size_t>(finger.bodies[b].body);
      const auto& tree = world_.meshes[body].haptic_tree;
      if (!tree || body >= X_WB.size()) continue;
      const Pose X_WG = X_WB[body] * world_.scene.bodies[body].haptic->X_BG;
      tree->forEachWithin(X_WG.inverseTimes(finger.center_W), kAroundFinger, [&](std::int32_t f) {
        if (corners->size() >= kMaxCorners) return;
        const MeshTree::Facet& facet = tree->facet(f);
        const auto corner = [&](std::size_t i) -> const Vec3& { return tree->corner(facet, i); };
        const Vec3 nhat_G = (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
        for (std::size_t i : {0, 1, 1, 2, 2, 0}) {
          corners->push_back(toOsg(X_WG * (corner(i) + kLift * nhat_G)));
          normals->push_back(toOsg(X_WG.q * nhat_G));
        }
      });
    }
  }
  lines_->setVertexArray(corners);
  lines_->setNormalArray(normals);
  lines_->removePrimitiveSet(0, lines_->getNumPrimitiveSets());
  lines_->addPrimitiveSet(new osg::DrawArrays(GL_LINES, 0, static_cast<GLsizei>(corners->size())));
  lines_->dirtyBound();
}

}  // namespace presa::view
