#include "modules/view_osg/patch_lines.h"

#include <osg/LineWidth>

#include "modules/view_osg/osg_convert.h"
#include "modules/view_osg/shaders.h"

namespace presa::view {
namespace {

constexpr double kLift = 2e-4;  ///< off the surface, so that the lines do not flicker with it [m]

}  // namespace

PatchLines::PatchLines() {
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

void PatchLines::update(bool shown, const ContactPatches* patches, const std::vector<Pose>& X_WB) {
  shown = shown && patches != nullptr;
  lines_->setNodeMask(shown ? ~0U : 0U);
  if (!shown) return;
  osg::ref_ptr<osg::Vec3Array> corners = new osg::Vec3Array, normals = new osg::Vec3Array(osg::Array::BIND_PER_VERTEX);
  for (std::size_t f = 0; f < static_cast<std::size_t>(patches->count); ++f) {
    const FingerPatch& finger = patches->fingers[f];
    for (std::size_t b = 0; b < static_cast<std::size_t>(finger.body_count); ++b) {
      const BodyPatch& patch = finger.bodies[b];
      const auto body = static_cast<std::size_t>(patch.body);
      if (patch.body < 0 || body >= X_WB.size()) continue;
      for (auto t = static_cast<std::size_t>(patch.first), end = t + static_cast<std::size_t>(patch.count); t < end;
           ++t) {
        const auto& v_B = finger.triangles[t].v_B;
        const Vec3 nhat_B = (v_B[1] - v_B[0]).cross(v_B[2] - v_B[0]).normalized();
        for (std::size_t i : {0, 1, 1, 2, 2, 0}) {
          corners->push_back(toOsg(X_WB[body] * (v_B[i] + kLift * nhat_B)));
          normals->push_back(toOsg(X_WB[body].q * nhat_B));
        }
      }
    }
  }
  lines_->setVertexArray(corners);
  lines_->setNormalArray(normals);
  lines_->removePrimitiveSet(0, lines_->getNumPrimitiveSets());
  lines_->addPrimitiveSet(new osg::DrawArrays(GL_LINES, 0, static_cast<GLsizei>(corners->size())));
  lines_->dirtyBound();
}

}  // namespace presa::view
