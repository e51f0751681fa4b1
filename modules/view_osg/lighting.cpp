#include "modules/view_osg/lighting.h"

#include <osg/PolygonOffset>
#include <osg/Program>

#include "modules/view_osg/osg_convert.h"

namespace presa::view {
namespace {

const Vec3 kKeyDirection = Vec3(0.38, -0.42, 0.95).normalized();  ///< towards the key light: over the right shoulder

constexpr double kKeeps = 1.2;  // kept maps reach beyond the focus by this factor

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
  due_ = true;
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
  // nothing is in the way beyond the map
  depth->setWrap(osg::Texture::WRAP_S, osg::Texture::CLAMP_TO_BORDER);
  depth->setWrap(osg::Texture::WRAP_T, osg::Texture::CLAMP_TO_BORDER);
  depth->setBorderColor({1, 1, 1, 1});

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

bool Lighting::setFocus(const Vec3& center, double radius) {
  const bool covered = (center - center_).norm() + radius < radius_ && radius > radius_ / 2;
  if (quality_.kept && covered) return false;
  center_ = center;
  radius_ = quality_.kept ? kKeeps * radius : radius;
  due_ = true;
  for (Map& map : maps_) {
    map.camera->setViewMatrixAsLookAt(toOsg(Vec3(center + 2 * radius_ * map.direction)), toOsg(center), toOsg(map.up));
    map.camera->setProjectionMatrixAsOrtho(-radius_, radius_, -radius_, radius_, 0, 4 * radius_);
    const osg::Matrixd to_texture = osg::Matrixd::translate(1, 1, 1) * osg::Matrixd::scale(0.5, 0.5, 0.5);
    map.matrix->set(osg::Matrixf(map.camera->getViewMatrix() * map.camera->getProjectionMatrix() * to_texture));
  }
  return true;
}

std::vector<Vec3> Lighting::directions() const {
  std::vector<Vec3> all;
  for (const Map& map : maps_) all.push_back(map.direction);
  return all;
}

bool Lighting::setGlow(double share) {
  float before = 0;
  glow_->get(before);
  const auto now = static_cast<float>(share);
  if (now == before) return false;
  glow_->set(now);
  return true;
}

void Lighting::beginFrame(bool moved) {
  const bool drawn = !quality_.kept || due_ || moved;
  for (Map& map : maps_) map.camera->setNodeMask(drawn ? ~0U : 0U);
  due_ = false;
}

void Lighting::setPictureSize(int width, int height) {
  picture_size_->set(osg::Vec2(static_cast<float>(width), static_cast<float>(height)));
}

}  // namespace presa::view
