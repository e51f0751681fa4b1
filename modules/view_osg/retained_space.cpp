#include "modules/view_osg/retained_space.h"

#include <algorithm>
#include <cmath>
#include <osg/FrameBufferObject>
#include <osg/GLExtensions>

#include "modules/view_osg/scene_nodes.h"
#include "modules/view_osg/shaders.h"

namespace presa::view {
namespace {

constexpr double kHudPeriod = 0.06;  ///< between two pictures of the head-up display [s]; nobody reads faster

void makeTarget(osg::Texture2D& texture, osg::Texture::FilterMode filter) {
  texture.setInternalFormat(GL_RGBA8);
  texture.setSourceFormat(GL_RGBA);
  texture.setSourceType(GL_UNSIGNED_BYTE);
  texture.setResizeNonPowerOfTwoHint(false);
  texture.setFilter(osg::Texture::MIN_FILTER, filter);
  texture.setFilter(osg::Texture::MAG_FILTER, filter);
}

void drawInto(osg::Camera& camera, osg::Texture2D& texture) {
  camera.setRenderOrder(osg::Camera::PRE_RENDER);
  camera.setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
  camera.attach(osg::Camera::COLOR_BUFFER, &texture);
}

/// Copies a texture into the window.
class CopyToWindow final : public osg::Drawable {
 public:
  explicit CopyToWindow(osg::Texture2D* texture) : source_(new osg::FrameBufferObject) {
    source_->setAttachment(osg::Camera::COLOR_BUFFER, osg::FrameBufferAttachment(texture));
    setCullingActive(false);
    setUseDisplayList(false);
  }
  void setSize(int width, int height) { width_ = width, height_ = height; }
  void drawImplementation(osg::RenderInfo& info) const override {
    osg::State& state = *info.getState();
    source_->apply(state, osg::FrameBufferObject::READ_FRAMEBUFFER);
    const auto* gl = state.get<osg::GLExtensions>();
    gl->glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    gl->glBindFramebuffer(GL_READ_FRAMEBUFFER_EXT, 0);
  }

 private:
  osg::ref_ptr<osg::FrameBufferObject> source_;
  int width_ = 0, height_ = 0;
};

void setShown(osg::Node& node, bool shown) { node.setNodeMask(shown ? ~0U : 0U); }

}  // namespace

RetainedSpace::RetainedSpace(Picture& picture) : picture_(picture) {
  makeTarget(*space_, osg::Texture::LINEAR);
  makeTarget(*hud_, osg::Texture::NEAREST);
  camera_->setName("space");
  drawInto(*camera_, *space_);
  camera_->setReferenceFrame(osg::Transform::RELATIVE_RF);
  camera_->setTransformOrder(osg::Camera::POST_MULTIPLY);
  camera_->setClearMask(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  camera_->attach(osg::Camera::DEPTH_BUFFER, GL_DEPTH_COMPONENT24);
  camera_->getOrCreateStateSet()->addUniform(crop_);
  camera_->addChild(picture.space());

  osg::Camera& hud = *picture.hud().camera();
  drawInto(hud, *hud_);
  hud.setClearMask(GL_COLOR_BUFFER_BIT);
  hud.setClearColor({0, 0, 0, 0});

  // in the window's own format, so that the copy is a plain one
  makeTarget(*window_, osg::Texture::NEAREST);
  window_->setSourceFormat(GL_BGRA);
  window_->setSourceType(GL_UNSIGNED_INT_8_8_8_8_REV);
  both_->setName("both");
  drawInto(*both_, *window_);
  both_->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
  both_->setClearMask(0);
  osg::ref_ptr<osg::Geometry> sheet = clipSpaceSheet(1);
  both_->addChild(sheet);
  osg::StateSet* state = sheet->getOrCreateStateSet();
  state->addUniform(part_);
  state->setAttributeAndModes(shaders::overlay());
  state->setTextureAttribute(0, space_, osg::StateAttribute::ON);
  state->setTextureAttribute(1, hud_, osg::StateAttribute::ON);
  state->addUniform(new osg::Uniform("space", 0));
  state->addUniform(new osg::Uniform("hud", 1));
  state->setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF);
  copy_ = new CopyToWindow(window_);
  for (osg::Node* part : {static_cast<osg::Node*>(camera_), static_cast<osg::Node*>(&hud),
                          static_cast<osg::Node*>(both_), static_cast<osg::Node*>(copy_)})
    root_->addChild(part);
}

void RetainedSpace::setSize(int width, int height, double share) {
  share_ = share;
  width_ = static_cast<int>(std::lround(share * width)), height_ = static_cast<int>(std::lround(share * height));
  picture_.setSize(width_, height_);
  camera_->resizeAttachments(width_, height_);
  const auto filter = share < 1 ? osg::Texture::LINEAR : osg::Texture::NEAREST;
  space_->setFilter(osg::Texture::MIN_FILTER, filter);
  space_->setFilter(osg::Texture::MAG_FILTER, filter);
  for (osg::Camera* camera : {picture_.hud().camera(), both_.get()}) {
    camera->resizeAttachments(width, height);
    camera->setViewport(0, 0, width, height);
  }
  static_cast<CopyToWindow&>(*copy_).setSize(width, height);
  pending_.all = true;
  hud_drawn_ = -1e300;
}

void RetainedSpace::prepare(const osg::Matrixd& view_projection, double clock, bool now) {
  const PixelRect drawn = drawSpace(view_projection);
  const bool due = now || clock - hud_drawn_ > kHudPeriod;
  setShown(*picture_.hud().camera(), due);
  if (due) hud_drawn_ = clock;
  combine(due ? PixelRect{0, 0, width_, height_} : drawn);
}

/// Returns the pixels that are drawn anew.
PixelRect RetainedSpace::drawSpace(const osg::Matrixd& view_projection) {
  pending_.add(picture_.takeChanges());
  if (view_projection != view_projection_) pending_.all = true;
  view_projection_ = view_projection;
  const PixelRect rect = changedPixels(pending_, view_projection, width_, height_);
  pending_ = {.all = false, .points = {}};
  setShown(*camera_, !rect.empty());
  if (rect.empty()) return rect;
  camera_->setViewport(rect.x, rect.y, rect.width, rect.height);
  camera_->setProjectionMatrix(cropTo(rect, width_, height_));
  crop_->set(osg::Vec2(1.0F * rect.y / height_, 1.0F * rect.height / height_));
  return rect;
}

/// Puts space and head-up display together where the space's pixels `drawn` are seen.
void RetainedSpace::combine(const PixelRect& drawn) {
  setShown(*both_, !drawn.empty());
  if (drawn.empty()) return;
  const osg::Viewport& hud = *picture_.hud().camera()->getViewport();
  const auto low = [&](int pixel) { return std::max(0.0, std::floor(pixel / share_) - 1); };
  const auto high = [&](int pixel, double size) { return std::min(size, std::ceil(pixel / share_) + 1); };
  const double x = low(drawn.x), y = low(drawn.y);
  const double width = high(drawn.x + drawn.width, hud.width()) - x;
  const double height = high(drawn.y + drawn.height, hud.height()) - y;
  both_->setViewport(static_cast<int>(x), static_cast<int>(y), static_cast<int>(width), static_cast<int>(height));
  part_->set(osg::Vec4d(x / hud.width(), y / hud.height(), width / hud.width(), height / hud.height()));
}

}  // namespace presa::view
