#include "modules/view_osg/retained_space.h"

#include <algorithm>
#include <cmath>
#include <osg/FrameBufferObject>
#include <osg/GLExtensions>

#include "modules/view_osg/placed_nodes.h"
#include "modules/view_osg/shaders.h"

namespace presa::view {
namespace {

constexpr double kHudPeriod = 0.06;  ///< between two pictures of the head-up display [s]; nobody reads faster

void makeTarget(osg::Texture2D& texture) {
  texture.setInternalFormat(GL_RGBA8);
  texture.setSourceFormat(GL_RGBA);
  texture.setSourceType(GL_UNSIGNED_BYTE);
  texture.setResizeNonPowerOfTwoHint(false);
}

void drawInto(osg::Camera& camera, osg::Texture2D& texture) {
  camera.setRenderOrder(osg::Camera::PRE_RENDER);
  camera.setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
  camera.setImplicitBufferAttachmentMask(0, 0);  // no buffer but those that are attached: none that nobody reads
  camera.attach(osg::Camera::COLOR_BUFFER, &texture);
}

void filter(osg::Texture2D& texture, bool smooth) {
  const auto mode = smooth ? osg::Texture::LINEAR : osg::Texture::NEAREST;
  texture.setFilter(osg::Texture::MIN_FILTER, mode);
  texture.setFilter(osg::Texture::MAG_FILTER, mode);
}

void resize(osg::Camera& camera, int width, int height) {
  camera.resizeAttachments(width, height);
  camera.setViewport(0, 0, width, height);
}

/// Copies a texture into the window, or lets it be grabbed.
class HandOut final : public osg::Drawable {
 public:
  HandOut(osg::Texture2D* texture, osg::ref_ptr<FrameGrabber> grabber)
      : source_(new osg::FrameBufferObject), grabber_(std::move(grabber)) {
    source_->setAttachment(osg::Camera::COLOR_BUFFER, osg::FrameBufferAttachment(texture));
    setCullingActive(false);
    setUseDisplayList(false);
  }
  void setSize(int width, int height) { width_ = width, height_ = height; }
  void drawImplementation(osg::RenderInfo& info) const override {
    osg::State& state = *info.getState();
    source_->apply(state, osg::FrameBufferObject::READ_FRAMEBUFFER);
    const auto* gl = state.get<osg::GLExtensions>();
    if (grabber_)
      (*grabber_)(info);
    else
      gl->glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    gl->glBindFramebuffer(GL_READ_FRAMEBUFFER_EXT, 0);
  }

 private:
  osg::ref_ptr<osg::FrameBufferObject> source_;
  osg::ref_ptr<FrameGrabber> grabber_;
  int width_ = 0, height_ = 0;
};

bool within(const PixelRect& inner, const PixelRect& outer) {
  return inner.x >= outer.x && inner.y >= outer.y && inner.x + inner.width <= outer.x + outer.width &&
         inner.y + inner.height <= outer.y + outer.height;
}

/// Adds a rectangle that none of the others holds, and takes out those that it holds.
void addTo(std::vector<PixelRect>& parts, const PixelRect& part) {
  const auto held = [&](const PixelRect& other) { return within(part, other); };
  if (part.empty() || std::ranges::any_of(parts, held)) return;
  std::erase_if(parts, [&](const PixelRect& other) { return within(other, part); });
  parts.push_back(part);
}

}  // namespace

RetainedSpace::RetainedSpace(Picture& picture, osg::ref_ptr<FrameGrabber> grabber) : picture_(picture) {
  makeTarget(*space_);
  makeTarget(*hud_);
  filter(*hud_, false);
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
  makeTarget(*window_);
  filter(*window_, false);
  window_->setSourceFormat(GL_BGRA);
  window_->setSourceType(GL_UNSIGNED_INT_8_8_8_8_REV);
  both_->setName("both");
  drawInto(*both_, *window_);
  both_->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
  both_->setClearMask(0);
  sheets_->setUseDisplayList(false);
  sheets_->setUseVertexBufferObjects(true);
  sheets_->setDataVariance(osg::Object::DYNAMIC);
  sheets_->setCullingActive(false);  // its places are in clip space
  sheets_->setVertexArray(new osg::Vec3Array);
  sheets_->setTexCoordArray(0, new osg::Vec2Array);
  sheets_->addPrimitiveSet(new osg::DrawArrays(GL_QUADS, 0, 0));
  both_->addChild(sheets_);
  both_->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
  osg::StateSet* state = sheets_->getOrCreateStateSet();
  state->addUniform(new osg::Uniform("part", osg::Vec4(0, 0, 1, 1)));
  state->setAttributeAndModes(shaders::overlay(false));
  state->setTextureAttribute(0, space_, osg::StateAttribute::ON);
  state->setTextureAttribute(1, hud_, osg::StateAttribute::ON);
  state->addUniform(new osg::Uniform("space", 0));
  state->addUniform(new osg::Uniform("hud", 1));
  state->setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF);
  copy_ = new HandOut(window_, std::move(grabber));
  for (osg::Node* part : {static_cast<osg::Node*>(camera_), static_cast<osg::Node*>(&hud),
                          static_cast<osg::Node*>(both_), static_cast<osg::Node*>(copy_)})
    root_->addChild(part);
}

void RetainedSpace::setSize(int width, int height, double share) {
  share_ = share;
  width_ = static_cast<int>(std::lround(share * width)), height_ = static_cast<int>(std::lround(share * height));
  picture_.setSize(width_, height_);
  camera_->resizeAttachments(width_, height_);
  filter(*space_, share < 1);
  if (share > 1) {
    osg::StateSet& state = *sheets_->getOrCreateStateSet();
    state.setAttributeAndModes(shaders::overlay(true));
    state.addUniform(new osg::Uniform("larger", static_cast<float>(share)));
  }
  resize(*picture_.hud().camera(), std::max(width, width_), std::max(height, height_));
  resize(*both_, width, height);
  static_cast<HandOut&>(*copy_).setSize(width, height);
  pending_.all = true;
  hud_drawn_ = -1e300;
}

void RetainedSpace::clearTo(float grey) {
  camera_->setClearColor({grey, grey, grey, 1});
  pending_.all = true;
}

void RetainedSpace::prepare(const osg::Matrixd& view_projection, double clock, bool now) {
  const PixelRect drawn = drawSpace(view_projection);
  const bool due = now || clock - hud_drawn_ > kHudPeriod;
  setShown(*picture_.hud().camera(), due);
  std::vector<PixelRect> parts;
  addTo(parts, inWindow(drawn));
  if (due) {
    hud_drawn_ = clock;
    for (const PixelRect& part : hud_parts_) addTo(parts, part);  // what was there may be gone
    hud_parts_ = hudParts();
    for (const PixelRect& part : hud_parts_) addTo(parts, part);
  }
  combine(parts);
}

/// Where the window shows the head-up display: a few panels and words; the rest of it is empty.
std::vector<PixelRect> RetainedSpace::hudParts() {
  osg::Camera& hud = *picture_.hud().camera();
  const osg::Viewport& window = *both_->getViewport();
  std::vector<Vec3> corners;
  for (unsigned i = 0; i < hud.getNumChildren(); ++i) addCorners(*hud.getChild(i), corners);
  std::vector<PixelRect> parts;
  constexpr std::size_t kCorners = 8;  // of each drawable
  for (std::size_t i = 0; i + kCorners <= corners.size(); i += kCorners) {
    const auto first = corners.begin() + static_cast<std::ptrdiff_t>(i);
    addTo(parts, changedPixels({.all = false, .points = {first, first + kCorners}}, hud.getProjectionMatrix(),
                               static_cast<int>(window.width()), static_cast<int>(window.height())));
  }
  return parts;
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

/// The pixels of the window in which pixels of the three-dimensional part are seen.
PixelRect RetainedSpace::inWindow(const PixelRect& drawn) const {
  if (drawn.empty()) return {};
  const osg::Viewport& window = *both_->getViewport();
  const auto low = [&](int pixel) { return static_cast<int>(std::max(0.0, std::floor(pixel / share_) - 1)); };
  const auto high = [&](int pixel, double size) {
    return static_cast<int>(std::min(size, std::ceil(pixel / share_) + 1));
  };
  const int x = low(drawn.x), y = low(drawn.y);
  return {x, y, high(drawn.x + drawn.width, window.width()) - x, high(drawn.y + drawn.height, window.height()) - y};
}

/// Puts space and head-up display together in these parts of the window. They may overlap: nothing is blended.
void RetainedSpace::combine(const std::vector<PixelRect>& parts) {
  setShown(*both_, !parts.empty());
  auto& places = static_cast<osg::Vec3Array&>(*sheets_->getVertexArray());
  auto& shares = static_cast<osg::Vec2Array&>(*sheets_->getTexCoordArray(0));
  places.clear(), shares.clear();
  const osg::Viewport& window = *both_->getViewport();
  for (const PixelRect& part : parts) {
    const double left = part.x / window.width(), right = (part.x + part.width) / window.width();
    const double low = part.y / window.height(), high = (part.y + part.height) / window.height();
    for (const osg::Vec2d& at : {osg::Vec2d(left, low), {right, low}, {right, high}, {left, high}}) {
      shares.push_back(osg::Vec2(at));
      places.push_back(osg::Vec3(osg::Vec2(at * 2 - osg::Vec2d(1, 1)), 0));
    }
  }
  places.dirty(), shares.dirty();
  static_cast<osg::DrawArrays&>(*sheets_->getPrimitiveSet(0)).setCount(static_cast<int>(places.size()));
}

}  // namespace presa::view
