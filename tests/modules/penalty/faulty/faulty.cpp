#include <limits>
#include <stdexcept>

#include "framework/haptics/renderer.h"

namespace presa {
namespace {

/// Correct in free space for a second, then wrong.
class Faulty final : public Renderer, public ProxyMover {
 public:
  explicit Faulty(const PluginElement& settings) : fault_(settings.text("fault")) {
    if (fault_ == "throws") throw std::runtime_error("no such method");
    nan_ = fault_ == "nan";
    moves_ = fault_ != "no_mover";
  }
  ProxyContact touch(const RenderInput& input) noexcept override {
    ProxyContact contact;
    contact.x = contact.state.x = contact.state.god_object = input.g;
    if (++ticks_ < 1000) return contact;
    if (nan_) {
      contact.depth = std::numeric_limits<double>::quiet_NaN();
    } else {
      contact.state.touching = true;
      contact.body = 1000000;
    }
    return contact;
  }
  const ProxyMover* mover() const noexcept override { return moves_ ? this : nullptr; }
  ProxyMove move(const Vec3&, const Vec3& g, double, Surroundings&) const noexcept override {
    ProxyMove moved;
    moved.x = moved.first_touch = g;
    return moved;
  }
  bool isSupported(const Vec3&, double, Surroundings&) const noexcept override { return false; }
  std::string what() const override { return "fail"; }

 private:
  std::string fault_;
  bool nan_ = false, moves_ = true;
  int ticks_ = 0;
};

const RendererPlugin kPlugin{.name = "faulty_renderer",
                             .create = [](const PluginElement& settings, const World&) -> std::unique_ptr<Renderer> {
                               return std::make_unique<Faulty>(settings);
                             }};

}  // namespace
}  // namespace presa

PRESA_RENDERER_PLUGIN(presa::kPlugin)
