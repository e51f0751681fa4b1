// The stored energy of a fingertip in a textured face is E = k max(0, d + h)^2 / 2: d is its depth below the face, k
// the stiffness, and h(x, y) <= 0 the height over the face at the touched point. The force is its negative gradient,
//   f = k (d + h) (nhat - grad h),
// because a motion along nhat lowers d, and one across it moves the touched point alike; on an edge, only along the
// edge. With h <= 0 it is zero where the contact with the face begins: no loop gains energy, nor one that leaves the
// face at another place than it came.
#include "framework/haptics/face_height.h"
#include "framework/haptics/felt_height.h"

namespace presa {
namespace {

class Texture final : public SurfaceEffect, public FeltHeight {
 public:
  explicit Texture(const PluginElement& element) : pattern_(element) {}

  void apply(const SurfaceInput& input, SurfaceContact& contact) noexcept override {
    const PatternOnFace at = pattern_.at(input);
    addHeight(pattern_.amplitude() * (at.s - 1), at.slope, contact);
  }
  double heightAt(const Vec3& p_T) const noexcept override { return pattern_.amplitude() * (pattern_.at(p_T).s - 1); }
  std::string what() const override { return "texture: " + pattern_.what(); }

 private:
  FacePattern pattern_;
};

const SurfaceEffectPlugin kPlugin{
    .name = "texture",
    .create = [](const PluginElement& element, const World& world) -> std::unique_ptr<SurfaceEffect> {
      requireFlatSides(element, world);
      return std::make_unique<Texture>(element);
    }};

}  // namespace
}  // namespace presa

PRESA_SURFACE_EFFECT_PLUGIN(presa::kPlugin)
