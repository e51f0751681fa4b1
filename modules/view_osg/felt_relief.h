#pragma once
#include <memory>
#include <osg/Geometry>
#include <vector>

#include "framework/core/state/contact_exchange.h"
#include "framework/haptics/felt_height.h"
#include "framework/haptics/surface_effect.h"

namespace presa::view {

/// Draws how high the felt surface is around each touching fingertip, on bodies with an effect of heights (FeltHeight):
/// dark hollows, light crests. Loads the effects when first shown. Waves below 0.6 mm are too fine for its cells.
class FeltRelief {
 public:
  explicit FeltRelief(const World& world);
  osg::Node* root() { return surface_; }
  /// Poses in the order of Scene::bodies. Throws InputError: the errors of surface effects.
  void update(bool shown, const ContactExchange& contacts, const std::vector<Pose>& X_WB);

 private:
  struct Felt {
    std::int32_t body;
    std::unique_ptr<SurfaceEffect> effect;
    const FeltHeight* height;  // of the effect
  };
  struct Patch;
  void load();
  double heightOn(std::int32_t body, const Vec3& p_T, const Pose& X_BT) const;
  void add(Patch& patch, const FingerContact& finger, const Pose& X_WB) const;

  const World& world_;
  bool loaded_ = false;
  std::vector<Felt> felt_;
  osg::ref_ptr<osg::Geometry> surface_ = new osg::Geometry;
};

}  // namespace presa::view
