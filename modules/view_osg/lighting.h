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
  int taps;      ///< shadow samples per pixel and map, at most 16
  int map_size;  ///< [pixel]
  bool kept;     ///< maps are kept while nothing moves and they cover the focus
};
inline constexpr LightQuality kFineLight{16, 2048, false};
inline constexpr LightQuality kQuickLight{1, 512, true};  ///< for software rendering

/// Two depth maps: from the key light (shadow) and from straight above (visibility of the sky at each point). Both
/// cover a sphere around the subject.
class Lighting {
 public:
  /// `casters` are drawn into both maps; the uniforms and textures are set on `receivers`.
  Lighting(osg::Node* casters, osg::StateSet* receivers);

  /// Cameras to be drawn before the picture.
  osg::Group* passes() { return passes_; }
  /// True if the maps were placed anew.
  bool setFocus(const Vec3& center, double radius);
  /// Directions towards the lights, unit vectors.
  std::vector<Vec3> directions() const;
  /// 0: daylight; 1: evening sun. True if that is a change.
  bool setGlow(double share);
  /// Starts a frame and draws the maps; a quick light only if something `moved`.
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
  bool due_ = true;  // the maps are not drawn yet
  Vec3 center_ = Vec3::Zero();
  double radius_ = 0;
  osg::ref_ptr<osg::Uniform> picture_size_, taps_, glow_ = new osg::Uniform("glow", 0.0F);
};

}  // namespace presa::view
