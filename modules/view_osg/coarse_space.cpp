#include "modules/view_osg/coarse_space.h"

#include <cmath>

#include "modules/view_osg/scene_nodes.h"
#include "modules/view_osg/shaders.h"

namespace presa::view {

CoarseSpace::CoarseSpace(Picture& picture) : picture_(picture) {
  texture_->setInternalFormat(GL_RGBA8);
  texture_->setSourceFormat(GL_RGBA);
  texture_->setSourceType(GL_UNSIGNED_BYTE);
  texture_->setResizeNonPowerOfTwoHint(false);
  texture_->setFilter(osg::Texture::MIN_FILTER, osg::Texture::LINEAR);
  texture_->setFilter(osg::Texture::MAG_FILTER, osg::Texture::LINEAR);
  camera_->setName("coarse");
  camera_->setRenderOrder(osg::Camera::PRE_RENDER);
  camera_->setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
  camera_->setReferenceFrame(osg::Transform::RELATIVE_RF);
  camera_->setClearMask(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  camera_->attach(osg::Camera::COLOR_BUFFER, texture_);
  camera_->attach(osg::Camera::DEPTH_BUFFER, GL_DEPTH_COMPONENT24);
  camera_->addChild(picture.space());

  screen_ = clipSpaceSheet(1);
  osg::StateSet* state = screen_->getOrCreateStateSet();
  state->setAttributeAndModes(shaders::copy());
  state->setTextureAttribute(0, texture_, osg::StateAttribute::ON);
  state->addUniform(new osg::Uniform("picture", 0));
  state->setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF);
  for (osg::Node* part : {static_cast<osg::Node*>(camera_), static_cast<osg::Node*>(screen_),
                          static_cast<osg::Node*>(picture.space()), static_cast<osg::Node*>(picture.hud().camera())})
    root_->addChild(part);
}

void CoarseSpace::setSize(int width, int height, double share) {
  const bool whole = share >= 1;
  root_->setChild(2, whole ? static_cast<osg::Node*>(picture_.space()) : new osg::Group);
  for (osg::Node* part : {static_cast<osg::Node*>(camera_), static_cast<osg::Node*>(screen_)})
    part->setNodeMask(whole ? 0U : ~0U);
  const int w = static_cast<int>(std::lround(share * width)), h = static_cast<int>(std::lround(share * height));
  picture_.setSize(w, h);
  if (whole) return;
  camera_->resizeAttachments(w, h);
  camera_->setViewport(0, 0, w, h);
}

}  // namespace presa::view
