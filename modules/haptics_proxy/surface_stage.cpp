// The surface effects of the touched body. They rotate and shift the rendered proxy about the HIP, so that the dynamics,
// which sees the spring between the two, gets the same force.
#include "framework/haptics/surface_effects.h"
#include "modules/haptics_proxy/finger_stage.h"

namespace presa {
namespace {

class Surfaces final : public SurfaceStage {
 public:
  Surfaces(const World& world, const SurfacesInForce& surfaces, const In<BodyHits>* hits)
      : surfaces_(surfaces), hits_(hits), effects_(world) {}

  void apply(FingerTick& tick) noexcept override {
    ProxyContact& contact = tick.contact;
    if (!contact.state.touching || !effects_.on(contact.body)) return;
    if (!effects_.act(inputOf(tick, contact), surfaces_.of(contact.body).stiffness, contact, tick.softness))
      tick.broken = true;
  }
  std::string what() const override {
    std::string all;
    for (const std::string& what : effects_.descriptions()) all += (all.empty() ? "" : "; ") + what;
    return all;
  }
  std::string broken() const override { return effects_.broken(); }

  bool changesFriction() const override { return effects_.changeFriction(); }
  // of several bodies that hold the finger each is asked where it touches the finger itself
  double friction(const FingerTick& tick, std::int32_t body) noexcept override {
    if (!effects_.on(body)) return 1;
    if (body == tick.contact.body) return effects_.friction(inputOf(tick, tick.contact));
    ProxyContact there = tick.contact;
    there.body = body;
    for (int i = 0; i < there.active.count; ++i) {
      const ActiveSet::Member& member = there.active.member[static_cast<std::size_t>(i)];
      if (member.body == body) there.nhat = member.nhat;
    }
    return effects_.friction(inputOf(tick, there));
  }

 private:
  SurfaceInput inputOf(const FingerTick& tick, const ProxyContact& contact) const noexcept {
    return {tick.index,
            tick.time,
            tick.period,
            tick.r,
            tick.g,
            contact,
            tick.X_WA,
            tick.touchables,
            *tick.finger.near,
            hits_ == nullptr ? nullptr : &hits_->value()};
  }

  const SurfacesInForce surfaces_;
  const In<BodyHits>* const hits_;
  SurfaceEffects effects_;
};

}  // namespace

std::unique_ptr<SurfaceStage> makeSurfaces(const World& world, const SurfacesInForce& surfaces,
                                           const In<BodyHits>* hits) {
  return std::make_unique<Surfaces>(world, surfaces, hits);
}

}  // namespace presa
