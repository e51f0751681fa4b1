#pragma once
#include <memory>
#include <string>

#include "framework/core/math/spatial.h"
#include "framework/scene/plugin_element.h"
#include "modules/texture_image/height_map.h"

namespace presa {

/// The image of an element on flat faces, repeated in tiles from the origin of the face's tangent frame on.
class ImageOnFace {
 public:
  /// From the attributes file, width, height. Bodies of one material share the image. Throws std::invalid_argument: the
  /// errors of readGreyPng. Thread: main or view.
  explicit ImageOnFace(const PluginElement& element);
  /// s in [-1, 1], black to white, and its slopes along x and y of the tangent frame [1/m]. Thread: any; nonblocking.
  PatternValue at(const Vec3& p_T) const noexcept;
  double maxSlope() const noexcept;  ///< upper bound of the slope [1/m]
  /// "weave.png", "tiles of 6 mm by 6 mm"
  const std::string& name() const { return name_; }
  std::string tiles() const;

 private:
  std::shared_ptr<const HeightMap> map_;
  std::string name_;
  double width_, height_;  // of a tile [m]
};

}  // namespace presa
