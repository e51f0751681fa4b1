#include "framework/haptics/renderer.h"

namespace presa {
namespace {

/// Pushes the tool out of every primitive that it overlaps: one contact for each, at most four.
class EveryBody final : public Renderer {
 public:
  ProxyContact touch(const RenderInput& input) noexcept override {
    ProxyContact contact;
    contact.swept = false;
    Vec3 sum = Vec3::Zero();
    double deepest = 0;
    input.near.focus(input.g, input.radius);
    input.near.forEachWithin(-1, input.g, input.radius, [&](const NearPiece& piece) {
      const double depth = input.radius - piece.at.distance;
      if (!(depth > 0) || input.contacts.add({piece.body, piece.at.nhat, depth}) == nullptr) return;
      sum += depth * piece.at.nhat;
      if (depth > deepest) deepest = depth, contact.body = piece.body;
    });
    contact.x = contact.state.x = contact.state.god_object = input.g + sum;
    if (input.contacts.empty()) return contact;
    contact.state.touching = contact.state.slipping = true;
    contact.depth = sum.norm();
    if (contact.depth > 0) contact.nhat = sum / contact.depth;
    return contact;
  }
  std::size_t maxOwnContacts() const noexcept override { return 4; }
  std::string what() const override { return "push out of every body"; }
};

const RendererPlugin kPlugin{.name = "every_body",
                             .create = [](const PluginElement&, const World&) -> std::unique_ptr<Renderer> {
                               return std::make_unique<EveryBody>();
                             }};

}  // namespace
}  // namespace presa

PRESA_RENDERER_PLUGIN(presa::kPlugin)
