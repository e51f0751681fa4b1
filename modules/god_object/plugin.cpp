#include "modules/god_object/god_object.h"

namespace presa {
namespace {

class GodObject final : public Renderer, public ProxyMover {
 public:
  ProxyContact touch(const RenderInput& input) noexcept override {
    return slideProxy(input.last, input.g, input.radius, input.near);
  }
  const ProxyMover* mover() const noexcept override { return this; }
  ProxyMove move(const Vec3& x, const Vec3& g, double radius, Surroundings& near) const noexcept override {
    return moveProxy(x, g, radius, near);
  }
  bool isSupported(const Vec3& x, double radius, Surroundings& near) const noexcept override {
    return presa::isSupported(x, radius, near);
  }
  std::string what() const override {
    return "move the proxy to the nearest reachable point (active set of at most three)";
  }
};

const RendererPlugin kPlugin{.name = "god_object",
                             .create = [](const PluginElement&, const World&) -> std::unique_ptr<Renderer> {
                               return std::make_unique<GodObject>();
                             }};

}  // namespace
}  // namespace presa

PRESA_RENDERER_PLUGIN(presa::kPlugin)
