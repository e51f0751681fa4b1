#pragma once
#include <osg/Camera>
#include <osg/Group>
#include <osg/Texture2D>
#include <osg/Uniform>
#include <vector>

#include "framework/core/math/spatial.h"

namespace presa::view {

/// Quality settings of the lighting.
struct LightQuality {
  int taps;       ///< shadow samples per pixel and map, at most 16
  int map_size;   ///< [pixel]
  int sky_every;  ///< frames between updates of the sky map
};
inline constexpr LightQuality kFineLight{16, 2048, 1};
inline constexpr LightQuality kQuickLight{1, 512, 12};  ///< for software rendering

/// Two depth maps: from the key light (shadow) and from straight above (visibility of the sky at each point). Both
/// cover a sphere around the subject.
class Lighting {
 public:
  /// `casters` are drawn into both maps; the uniforms and textures are set on `receivers`.
  Lighting(osg::Node* casters, osg::StateSet* receivers);

  /// Cameras to be drawn before the picture.
  osg::Group* passes() { return passes_; }
  void setFocus(const Vec3& center, double radius);
  /// 0: daylight; 1: evening sun.
  void setGlow(double share) { glow_->set(static_cast<float>(share)); }
  /// Starts a frame and draws the maps that are due. A quick light updates the shadow only when something `moved`, and
  /// the sky map occasionally.
  void beginFrame(bool moved);
  void setQuality(const LightQuality& quality);
  /// Size of the picture [pixel].
  void setPictureSize(int width, int height);

 private:
  struct Map {
    osg::ref_ptr<osg::Camera> camera;
    osg::ref_ptr<osg::Texture2D> depth;
    osg::ref_ptr<osg::Uniform> matrix;
    Vec3 direction;  ///< direction to the light
    Vec3 up;
  };
  void addMap(const char* name, int unit, const Vec3& direction, const Vec3& up, osg::Node* casters,
              osg::StateSet* receivers);

  osg::ref_ptr<osg::Group> passes_ = new osg::Group;
  std::vector<Map> maps_;
  LightQuality quality_ = kFineLight;
  int frame_ = 0;  // frames since the maps were placed
  Vec3 center_ = Vec3::Zero();
  double radius_ = 0;
  osg::ref_ptr<osg::Uniform> picture_size_, taps_, glow_ = new osg::Uniform("glow", 0.0F);
};

}  // namespace presa::view
