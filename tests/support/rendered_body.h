#pragma once
#include <memory>
#include <string>

#include "framework/core/math/spatial.h"
#include "framework/haptics/body_hits.h"

namespace presa::test {

/// A fingertip of 8 mm that feels a fixed body of 1000 N/m at the origin, by one renderer and the body's surface
/// effects, without friction and without a run. The elements are read like any scene's, with the plug-ins' manifests:
///
///     RenderedBody box("<haptics renderer=\"god_object\"/>", "<box size=\"0.1 0.1 0.1\"/>");
///     box.force({0, 0, 0.1});
///     EXPECT_NEAR(box.force({0, 0, 0.057}).z(), 1, 1e-9);
class RenderedBody {
 public:
  /// `haptics`: the scene's `<haptics>` and effects that stand in the scene, or empty; `shape`: the haptic geometry of
  /// the body; `effects`: surface effects of the body; `material_effects`: of its material. Throws InputError with every
  /// finding.
  RenderedBody(const std::string& haptics, const std::string& shape, const std::string& effects = {},
               const std::string& material_effects = {});
  ~RenderedBody();

  /// One tick of 1 ms with the device at p_WH. Returns the force on it [N]; NaN if the renderer or an effect breaks
  /// its contract. In the first tick the fingertip should be free.
  /// Nonblocking if the plug-ins are: put a RealTimeGuard around it.
  Vec3 force(const Vec3& p_WH) noexcept;
  /// A hit between bodies that surface effects may hear from the next tick on. The body has the index 0 and the
  /// material 'any'; index 1 is one of material 'other', which has no geometry.
  void hear(const BodyHit& hit) noexcept;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace presa::test
