#include "modules/view_osg/lighting.h"

#include <osg/PolygonOffset>
#include <osg/Program>

#include "modules/view_osg/osg_convert.h"

namespace presa::view {
namespace {

const Vec3 kKeyDirection = Vec3(0.38, -0.42, 0.95).normalized();  ///< towards the key light: over the right shoulder

constexpr double kKeeps = 1.2;  // coverage margin of the maps, relative to their radius

}  // namespace

Lighting::Lighting(osg::Node* casters, osg::StateSet* receivers) {
  addMap("key", 0, kKeyDirection, Vec3::UnitZ(), casters, receivers);
  addMap("sky", 1, Vec3::UnitZ(), Vec3::UnitY(), casters, receivers);
  receivers->addUniform(new osg::Uniform("key_direction", osg::Vec3(toOsg(kKeyDirection))));
  picture_size_ = new osg::Uniform("picture_size", osg::Vec2(1, 1));
  receivers->addUniform(picture_size_);
  taps_ = new osg::Uniform("taps", 0);
  receivers->addUniform(taps_);
  receivers->addUniform(glow_);
  setQuality(kFineLight);
}

void Lighting::setQuality(const LightQuality& quality) {
  quality_ = quality;
  frame_ = 0;
  taps_->set(quality.taps);
  for (Map& map : maps_) {
    map.depth->setTextureSize(quality.map_size, quality.map_size);
    map.camera->setViewport(0, 0, quality.map_size, quality.map_size);
  }
}

void Lighting::addMap(const char* name, int unit, const Vec3& direction, const Vec3& up, osg::Node* casters,
                      osg::StateSet* receivers) {
  osg::ref_ptr<osg::Texture2D> depth = new osg::Texture2D;
  depth->setInternalFormat(GL_DEPTH_COMPONENT24);
  depth->setSourceFormat(GL_DEPTH_COMPONENT);
  depth->setShadowComparison(true);
  depth->setShadowCompareFunc(osg::Texture::LEQUAL);
  depth->setFilter(osg::Texture::MIN_FILTER, osg::Texture::LINEAR);
  depth->setFilter(osg::Texture::MAG_FILTER, osg::Texture::LINEAR);
  depth->setWrap(osg::Texture::WRAP_S, osg::Texture::CLAMP_TO_EDGE);
  depth->setWrap(osg::Texture::WRAP_T, osg::Texture::CLAMP_TO_EDGE);

  osg::ref_ptr<osg::Camera> camera = new osg::Camera;
  camera->setName(std::string(name) + " map");
  camera->setRenderOrder(osg::Camera::PRE_RENDER);
  camera->setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
  camera->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
  camera->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
  camera->setClearMask(GL_DEPTH_BUFFER_BIT);
  camera->attach(osg::Camera::DEPTH_BUFFER, depth);
  camera->addChild(casters);
  // depth only: the bodies' own shaders are not needed
  osg::StateSet* state = camera->getOrCreateStateSet();
  state->setAttributeAndModes(new osg::Program, osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE);
  state->setAttributeAndModes(new osg::PolygonOffset(1.5F, 4.0F), osg::StateAttribute::ON);
  passes_->addChild(camera);

  receivers->setTextureAttributeAndModes(static_cast<unsigned>(unit), depth, osg::StateAttribute::ON);
  receivers->addUniform(new osg::Uniform((std::string(name) + "_map").c_str(), unit));
  osg::ref_ptr<osg::Uniform> matrix = new osg::Uniform(osg::Uniform::FLOAT_MAT4, std::string(name) + "_matrix");
  receivers->addUniform(matrix);
  maps_.push_back({camera, depth, matrix, direction, up});
}

void Lighting::setFocus(const Vec3& center, double radius) {
  // a quick light keeps its maps as long as they cover the focus
  const bool covered = (center - center_).norm() + radius < kKeeps * radius_ && radius > radius_ / 2;
  if (quality_.sky_every > 1 && frame_ > 0 && covered) return;
  center_ = center;
  radius_ = radius;
  frame_ = 0;
  for (Map& map : maps_) {
    map.camera->setViewMatrixAsLookAt(toOsg(Vec3(center + 2 * radius * map.direction)), toOsg(center), toOsg(map.up));
    map.camera->setProjectionMatrixAsOrtho(-radius, radius, -radius, radius, 0, 4 * radius);
    const osg::Matrixd to_texture = osg::Matrixd::translate(1, 1, 1) * osg::Matrixd::scale(0.5, 0.5, 0.5);
    map.matrix->set(osg::Matrixf(map.camera->getViewMatrix() * map.camera->getProjectionMatrix() * to_texture));
  }
}

void Lighting::beginFrame(bool moved) {
  const bool fine = quality_.sky_every == 1, first = frame_ == 0;
  maps_.front().camera->setNodeMask(fine || first || moved ? ~0U : 0U);
  maps_.back().camera->setNodeMask(fine || frame_ % quality_.sky_every == 0 ? ~0U : 0U);
  ++frame_;
}

void Lighting::setPictureSize(int width, int height) {
  picture_size_->set(osg::Vec2(static_cast<float>(width), static_cast<float>(height)));
}

}  // namespace presa::view
