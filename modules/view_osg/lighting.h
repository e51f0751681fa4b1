#pragma once
#include <osg/Camera>
#include <osg/Group>
#include <osg/Texture2D>
#include <osg/Uniform>
#include <vector>

#include "framework/core/math/spatial.h"
#include "framework/scene/picture_options.h"

namespace presa::view {

/// Quality settings of the lighting.
struct LightQuality {
  int map_size;  ///< [pixel]
  bool quick;    ///< for software rendering: shadows are softened in the maps, which are kept while nothing moves
};
inline constexpr LightQuality kFineLight{1024, false};
inline constexpr LightQuality kQuickLight{384, true};

/// Two depth maps: from the key light (shadow) and from straight above (visibility of the sky at each point). Both
/// cover a sphere around the subject. A fine light softens shadows by many samples at each pixel of the picture; a quick
/// one keeps mean and mean square of the depths around each point of a smaller map, from which one sample tells the
/// share of light (variance shadow maps: Donnelly and Lauritzen 2006).
class Lighting {
 public:
  /// `casters` are drawn into both maps; the uniforms and textures are set on `receivers`.
  Lighting(osg::Node* casters, osg::StateSet* receivers, PictureOptions::Light light = {});

  /// Cameras to be drawn before the picture.
  osg::Group* passes() { return passes_; }
  /// True if the maps were placed anew.
  bool setFocus(const Vec3& center, double radius);
  /// Directions towards the lights, unit vectors.
  std::vector<Vec3> directions() const;
  /// How much farther shadows reach than at noon.
  double reach() const { return evening_ ? 1.4 : 1; }
  /// 0: daylight, or evening if that is the light; 1: evening sun. True if that is a change.
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
    osg::ref_ptr<osg::Texture2D> soft;                 ///< mean [m] and mean square [m²] of depths
    std::vector<osg::ref_ptr<osg::Camera>> softening;  ///< passes that make it
    osg::ref_ptr<osg::Uniform> depth_range;            ///< [m]
  };
  void addMap(const char* name, int unit, const Vec3& direction, const Vec3& up, osg::Node* casters);

  osg::ref_ptr<osg::Group> passes_ = new osg::Group;
  osg::ref_ptr<osg::StateSet> receivers_;
  std::vector<Map> maps_;
  const bool evening_;
  LightQuality quality_ = kFineLight;
  bool due_ = true;  // the maps are not drawn yet
  Vec3 center_ = Vec3::Zero();
  double radius_ = 0;
  osg::ref_ptr<osg::Uniform> picture_size_, glow_ = new osg::Uniform("glow", 0.0F);
};

}  // namespace presa::view
