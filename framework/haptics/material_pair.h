#pragma once
#include <string>

#include "framework/haptics/body_hits.h"
#include "framework/scene/plugin_element.h"
#include "framework/scene/scene.h"

namespace presa {

/// The pair of materials that an element names by its attributes `a` and `b`, of type material.
class MaterialPair {
 public:
  /// Throws std::invalid_argument (E596) where another element of that name names the same pair.
  MaterialPair(const PluginElement& element, const Scene& scene);

  /// Whether the two bodies of the hit are of these materials.
  bool holds(const BodyHit& hit, const Scene& scene) const noexcept;

 private:
  std::size_t a_, b_;  // indices into Scene::materials, a_ <= b_
};

}  // namespace presa
