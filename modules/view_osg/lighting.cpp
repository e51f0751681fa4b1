#include "modules/view_osg/lighting.h"

#include <osg/Geometry>
#include <osg/PolygonOffset>
#include <osg/Program>

#include "modules/view_osg/osg_convert.h"
#include "modules/view_osg/scene_nodes.h"
#include "modules/view_osg/shaders.h"

namespace presa::view {
namespace {

const Vec3 kKeyDirection = Vec3(0.38, -0.42, 0.95).normalized();  ///< towards the key light: over the right shoulder
const Vec3 kLowDirection = Vec3(0.80, -0.46, 0.58).normalized();  ///< in the evening: 32 degrees high

// moments: size of the maps, and half width of the blur [texel]; the sky is a wide light
constexpr int kKeyTexels = 192, kSkyTexels = 64;
constexpr int kKeyBlur = 1, kSkyBlur = 2;
constexpr double kKeeps = 1.2;  // kept maps reach beyond the focus by this factor

/// Beyond the map, nothing is in the way.
void wrapInLight(osg::Texture2D& map, const osg::Vec4d& far) {
  map.setWrap(osg::Texture::WRAP_S, osg::Texture::CLAMP_TO_BORDER);
  map.setWrap(osg::Texture::WRAP_T, osg::Texture::CLAMP_TO_BORDER);
  map.setBorderColor(far);
}

osg::ref_ptr<osg::Texture2D> makeMoments(int texels) {
  osg::ref_ptr<osg::Texture2D> map = new osg::Texture2D;
  map->setTextureSize(texels, texels);
  map->setInternalFormat(GL_RG32F);
  map->setSourceFormat(GL_RG);
  map->setSourceType(GL_FLOAT);
  map->setFilter(osg::Texture::MIN_FILTER, osg::Texture::LINEAR);
  map->setFilter(osg::Texture::MAG_FILTER, osg::Texture::LINEAR);
  wrapInLight(*map, {1e3, 1e6, 0, 0});
  return map;
}

/// Draws `target` from the texture `source` with a program.
osg::ref_ptr<osg::Camera> softeningPass(int order, osg::Program* program, osg::Texture2D* source,
                                        osg::Texture2D* target, osg::Uniform* range) {
  osg::ref_ptr<osg::Camera> camera = new osg::Camera;
  camera->setRenderOrder(osg::Camera::PRE_RENDER, order);
  camera->setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
  camera->setImplicitBufferAttachmentMask(0, 0);
  camera->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
  camera->setClearMask(0);
  camera->setViewport(0, 0, target->getTextureWidth(), target->getTextureHeight());
  camera->attach(osg::Camera::COLOR_BUFFER, target);
  const osg::ref_ptr<osg::Geometry> sheet = clipSpaceSheet(1);
  osg::StateSet* state = sheet->getOrCreateStateSet();
  state->setAttributeAndModes(program);
  state->setTextureAttribute(0, source);
  state->addUniform(new osg::Uniform("source", 0));
  state->addUniform(new osg::Uniform("part", osg::Vec4(0, 0, 1, 1)));
  state->addUniform(range);
  state->setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF);
  camera->addChild(sheet);
  return camera;
}

}  // namespace

Lighting::Lighting(osg::Node* casters, osg::StateSet* receivers, PictureOptions::Light light)
    : receivers_(receivers), evening_(light == PictureOptions::Light::kEvening) {
  const Vec3 key = evening_ ? kLowDirection : kKeyDirection;
  addMap("key", kKeyTexels, key, Vec3::UnitZ(), casters);
  addMap("sky", kSkyTexels, Vec3::UnitZ(), Vec3::UnitY(), casters);
  receivers->addUniform(new osg::Uniform("key_direction", osg::Vec3(toOsg(key))));
  picture_size_ = new osg::Uniform("picture_size", osg::Vec2(1, 1));
  receivers->addUniform(picture_size_);
  receivers->addUniform(glow_);
  setGlow(0);
  setQuality(kFineLight);
}

void Lighting::setQuality(const LightQuality& quality) {
  quality_ = quality;
  due_ = true;
  radius_ = 0;
  for (std::size_t unit = 0; unit < maps_.size(); ++unit) {
    Map& map = maps_[unit];
    map.depth->setTextureSize(quality.map_size, quality.map_size);
    map.depth->setShadowComparison(!quality.quick);
    const auto filter = quality.quick ? osg::Texture::NEAREST : osg::Texture::LINEAR;
    map.depth->setFilter(osg::Texture::MIN_FILTER, filter);
    map.depth->setFilter(osg::Texture::MAG_FILTER, filter);
    map.camera->setViewport(0, 0, quality.map_size, quality.map_size);
    receivers_->setTextureAttributeAndModes(static_cast<unsigned>(unit), quality.quick ? map.soft : map.depth);
  }
}

void Lighting::addMap(const char* name, int texels, const Vec3& direction, const Vec3& up, osg::Node* casters) {
  osg::ref_ptr<osg::Texture2D> depth = new osg::Texture2D;
  depth->setInternalFormat(GL_DEPTH_COMPONENT24);
  depth->setSourceFormat(GL_DEPTH_COMPONENT);
  depth->setShadowCompareFunc(osg::Texture::LEQUAL);
  wrapInLight(*depth, {1, 1, 1, 1});

  osg::ref_ptr<osg::Camera> camera = new osg::Camera;
  camera->setName(std::string(name) + " map");
  camera->setRenderOrder(osg::Camera::PRE_RENDER, 0);
  camera->setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
  camera->setImplicitBufferAttachmentMask(0, 0);  // no colours
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

  const int unit = static_cast<int>(maps_.size());
  receivers_->addUniform(new osg::Uniform((std::string(name) + "_map").c_str(), unit));
  osg::ref_ptr<osg::Uniform> matrix = new osg::Uniform(osg::Uniform::FLOAT_MAT4, std::string(name) + "_matrix");
  receivers_->addUniform(matrix);
  osg::ref_ptr<osg::Uniform> range = new osg::Uniform("depth_range", 1.0F);
  const osg::ref_ptr<osg::Texture2D> rough = makeMoments(texels), soft = makeMoments(texels);
  const std::vector<osg::ref_ptr<osg::Camera>> softening{
      softeningPass(1, shaders::moments(kQuickLight.map_size / texels), depth, rough, range),
      softeningPass(2, shaders::blur(unit == 0 ? kKeyBlur : kSkyBlur), rough, soft, range)};
  for (const auto& pass : softening) passes_->addChild(pass);
  maps_.push_back({camera, depth, matrix, direction, up, soft, softening, range});
}

bool Lighting::setFocus(const Vec3& center, double radius) {
  const bool covered = (center - center_).norm() + radius < radius_ && radius > radius_ / 2;
  if (quality_.quick && covered) return false;
  center_ = center;
  radius_ = quality_.quick ? kKeeps * radius : radius;
  due_ = true;
  for (Map& map : maps_) {
    map.camera->setViewMatrixAsLookAt(toOsg(Vec3(center + 2 * radius_ * map.direction)), toOsg(center), toOsg(map.up));
    map.camera->setProjectionMatrixAsOrtho(-radius_, radius_, -radius_, radius_, 0, 4 * radius_);
    const double range = 4 * radius_;
    const osg::Matrixd to_texture =
        osg::Matrixd::translate(1, 1, 1) * osg::Matrixd::scale(0.5, 0.5, quality_.quick ? 0.5 * range : 0.5);
    map.depth_range->set(static_cast<float>(range));
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
  const auto now = static_cast<float>(evening_ ? 1 : share);
  if (now == before) return false;
  glow_->set(now);
  return true;
}

void Lighting::beginFrame(bool moved) {
  const bool drawn = !quality_.quick || due_ || moved;
  for (Map& map : maps_) {
    map.camera->setNodeMask(drawn ? ~0U : 0U);
    for (const auto& pass : map.softening) pass->setNodeMask(drawn && quality_.quick ? ~0U : 0U);
  }
  due_ = false;
}

void Lighting::setPictureSize(int width, int height) {
  picture_size_->set(osg::Vec2(static_cast<float>(width), static_cast<float>(height)));
}

}  // namespace presa::view
