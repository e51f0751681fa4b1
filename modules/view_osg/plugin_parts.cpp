#include "modules/view_osg/plugin_parts.h"

#include <osg/LineWidth>

#include "framework/haptics/plugin_object.h"
#include "modules/view_osg/osg_convert.h"
#include "modules/view_osg/shaders.h"

namespace presa::view {
namespace {

/// Collects lines for one drawing call.
class Lines final : public Canvas {
 public:
  void line(const Vec3& p_WA, const Vec3& p_WB, const Vec3& color) override {
    if (!p_WA.allFinite() || !p_WB.allFinite() || !color.allFinite()) return;
    for (const Vec3& end : {p_WA, p_WB}) {
      ends->push_back(toOsg(end));
      colors->push_back(osg::Vec4(toOsg(color), 1.0F));
      normals->push_back({0, 0, 1});
    }
  }

  osg::ref_ptr<osg::Vec3Array> ends = new osg::Vec3Array, normals = new osg::Vec3Array(osg::Array::BIND_PER_VERTEX);
  osg::ref_ptr<osg::Vec4Array> colors = new osg::Vec4Array(osg::Array::BIND_PER_VERTEX);
};

ViewMoment momentOf(const ViewFrame& frame) { return {frame.time, frame.X_WB, frame.device, frame.contacts}; }

}  // namespace

PluginParts::PluginParts() {
  lines_->setName("parts of plug-ins");
  lines_->setDataVariance(osg::Object::DYNAMIC);
  lines_->setUseDisplayList(false);
  lines_->setUseVertexBufferObjects(true);
  osg::StateSet* state = lines_->getOrCreateStateSet();
  state->setAttributeAndModes(shaders::glyph());
  state->addUniform(new osg::Uniform("opacity", 1.0F));
  state->setAttributeAndModes(new osg::LineWidth(2.0F));
}

std::unique_ptr<PluginParts> PluginParts::of(std::shared_ptr<const World> world) {
  std::unique_ptr<PluginParts> all;
  for (const PluginElement& element : world->scene.plugin_elements) {
    if (element.kind != PluginKind::kViewPart) continue;
    if (!all) all.reset(new PluginParts);
    const auto& table = pluginTable<ViewPartPlugin>(element.plugin, "presaViewPartPlugin");
    all->parts_.push_back(madeFor(element, [&] { return table.create(element, *world); }));
  }
  if (all) all->world_ = std::move(world);
  return all;
}

void PluginParts::follow(const ViewFrame& frame) {
  for (const auto& part : parts_) part->follow(momentOf(frame));
}

void PluginParts::draw(const ViewFrame& frame) {
  Lines lines;
  for (const auto& part : parts_) part->draw(momentOf(frame), lines);
  lines_->setVertexArray(lines.ends);
  lines_->setColorArray(lines.colors);
  lines_->setNormalArray(lines.normals);
  lines_->removePrimitiveSet(0, lines_->getNumPrimitiveSets());
  lines_->addPrimitiveSet(new osg::DrawArrays(GL_LINES, 0, static_cast<GLsizei>(lines.ends->size())));
  lines_->dirtyBound();
}

std::vector<std::string> PluginParts::what() const {
  std::vector<std::string> all;
  for (const auto& part : parts_) all.push_back(part->what());
  return all;
}

}  // namespace presa::view
