// A finger at the depth d stores E = K F(d), K the stiffness of the material, F the integral of the profile's force f,
// and feels K f(d) along the normal. The contact gets the slope of that force as its stiffness and a depth that gives
// the force: the dynamics goes on from its sample of the finger along the tangent, so a free body gets what is felt.
//
// Friction. Its stretch t lies within mu d; a force K f(d) t / d would keep that ratio, but depends on d: a finger that
// sticks could stretch it near the surface and let it go below. While it sticks, the layers give way along the surface
// as they do along the normal, f_t = K m f(t / m), with m = mu_static: a function of t alone, with the energy
// K m^2 F(t / m), and the force mu K f(d) where t = mu d. Where it slides, the ratio holds: f_t = K f(d) t / d.
#include <algorithm>
#include <sstream>

#include "framework/haptics/surface_effect.h"
#include "modules/layers/profile.h"

namespace presa {
namespace {

class Layers final : public SurfaceEffect {
 public:
  Layers(const PluginElement& element, const Material& material)
      : profile_(element.number("skin"), element.number("core"), element.number("thickness"),
                 element.number("transition")),
        mu_(material.friction_static) {
    std::ostringstream text;
    text << "layers: " << 100 * element.number("skin") << " % of the stiffness down to "
         << 1e3 * element.number("thickness") << " mm, " << 100 * element.number("core") << " % from "
         << 1e3 * (element.number("thickness") + element.number("transition")) << " mm on";
    what_ = text.str();
  }

  void apply(const SurfaceInput& input, SurfaceContact& contact) noexcept override {
    // below a texture, whose force leans by its slope: the depth along the normal of the face
    const double depth = contact.depth * contact.nhat.dot(input.contact.nhat);
    if (!(depth > 0)) return;
    const double tangent = profile_.tangent(depth), secant = profile_.secant(depth);
    contact.depth *= secant / tangent;
    contact.stiffness *= tangent;
    if (input.contact.state.slipping || !(mu_ > 0)) return;
    // Presa lets the tangential displacement fall with the depth
    contact.tangential *= profile_.secant(std::min(contact.tangential.norm() / mu_, depth)) / secant;
  }
  std::string what() const override { return what_; }

 private:
  LayerProfile profile_;
  double mu_;
  std::string what_;
};

const SurfaceEffectPlugin kPlugin{
    .name = "layers", .create = [](const PluginElement& element, const World& world) -> std::unique_ptr<SurfaceEffect> {
      const Body& body = world.scene.bodies[static_cast<std::size_t>(element.body)];
      return std::make_unique<Layers>(element, world.scene.materialOf(body));
    }};

}  // namespace
}  // namespace presa

PRESA_SURFACE_EFFECT_PLUGIN(presa::kPlugin)
