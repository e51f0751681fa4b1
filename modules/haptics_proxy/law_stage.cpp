#include <algorithm>
#include <array>
#include <atomic>
#include <vector>

#include "framework/haptics/friction_laws.h"
#include "modules/haptics_proxy/finger_stage.h"
#include "modules/haptics_proxy/friction.h"

namespace presa {
namespace {

/// The laws of the scene, and what both stages below do with them.
class LawStage : public FrictionStage {
 public:
  LawStage(const SurfacesInForce& surfaces, const Renderer& renderer)
      : surfaces_(surfaces), laws_(surfaces.scene), mover_(*renderer.mover()) {
    const std::size_t max_bodies = std::max(renderer.maxOwnContacts(), std::tuple_size_v<decltype(ActiveSet::member)>);
    for (std::size_t finger = 0; finger < surfaces.scene.devices.size(); ++finger) held_.emplace_back(max_bodies);
  }

  void apply(FingerTick& tick) noexcept final {
    const std::int32_t main = tick.contact.body != kNoBody ? tick.contact.body : tick.finger.frame;
    if (main == kNoBody) return;
    Held& held = held_[tick.index];
    const std::int32_t body =
        holdByFriction(tick.contact, {tick.own_contacts.begin(), tick.own_contacts.end()}, tick.finger.tip, held,
                       tick.g, tick.r, InTick(*this, tick, main), mover_, *tick.finger.near);
    if (body != kNoBody) {
      int none = -1;
      broken_.compare_exchange_strong(none, body, std::memory_order_acq_rel);
    }
    tick.broken = tick.broken || broken_.load(std::memory_order_relaxed) >= 0;
    if (tick.contact.state.touching) tick.friction = {held.bodies.begin(), held.bodies.end()};
  }

  void changeFrame(std::size_t finger, const Pose& X_BA) noexcept override {
    Held& held = held_[finger];
    held.anchor = X_BA * held.anchor;
    held.g = X_BA * held.g;
    for (BodyFriction& one : held.bodies) {
      one.anchor = X_BA * one.anchor;
      one.law.vector = X_BA.q * one.law.vector;
    }
  }

  std::optional<std::string> brokenLaw() const override {
    const int body = broken_.load(std::memory_order_acquire);
    if (body < 0) return std::nullopt;
    const Material& material = surfaces_.scene.materialOf(surfaces_.scene.bodies[static_cast<std::size_t>(body)]);
    return "friction law '" + laws_.nameOf(body) + "' of material '" + material.name + "'";
  }

 protected:
  virtual FrictionCoefficients coefficientsOf(const FingerTick& tick, std::int32_t body) const noexcept = 0;
  std::string names() const {
    std::string all;
    for (const std::string& name : laws_.names()) all += (all.empty() ? "" : ", ") + name;
    return all;
  }
  const SurfacesInForce surfaces_;

 private:
  class InTick final : public Friction {
   public:
    InTick(const LawStage& stage, const FingerTick& tick, std::int32_t main)
        : Friction(stage.surfaces_.of(main).stiffness, tick.period), stage_(stage), tick_(tick) {}
    BodyLaw of(std::int32_t body) const noexcept override {
      const FrictionCoefficients mu = stage_.coefficientsOf(tick_, body);
      BodyLaw with{stage_.laws_.of(body), mu.mu_static, mu.mu_dynamic};
      if (body != tick_.finger.frame) with.q_BA = tick_.touchables.frameOf(body).q.conjugate() * tick_.X_WA.q;
      return with;
    }

   private:
    const LawStage& stage_;
    const FingerTick& tick_;
  };

  const FrictionLaws laws_;
  const ProxyMover& mover_;
  std::vector<Held> held_;       // by finger
  std::atomic<int> broken_{-1};  // body
};

class SteadyFriction : public LawStage {
 public:
  using LawStage::LawStage;
  std::string what() const override { return "friction: " + names(); }

 protected:
  FrictionCoefficients coefficientsOf(const FingerTick&, std::int32_t body) const noexcept override {
    const Material& material = surfaces_.of(body);
    return {material.friction_static, material.friction_dynamic};
  }
};

/// Uses the changed coefficients from the tick of the change on; a sticking finger outside the new bound then slips.
class ChangingFriction : public LawStage {
 public:
  ChangingFriction(const SurfacesInForce& surfaces, const Renderer& renderer, const In<SurfaceChange>& change)
      : LawStage(surfaces, renderer), change_(change) {
    for (const Body& body : surfaces.scene.bodies) {
      const Material& material = surfaces.scene.materialOf(body);
      const FrictionCoefficients before{material.friction_static, material.friction_dynamic};
      coefficients_.push_back({before, material.changed_friction.value_or(before)});
    }
  }
  std::string what() const override {
    return "friction: " + names() + ", with other coefficients after the surface change";
  }

 protected:
  FrictionCoefficients coefficientsOf(const FingerTick&, std::int32_t body) const noexcept override {
    return coefficients_[static_cast<std::size_t>(body)][change_->happened ? 1 : 0];
  }

 private:
  std::vector<std::array<FrictionCoefficients, 2>> coefficients_;  // by body: before and after
  const In<SurfaceChange>& change_;
};

/// Coefficients that surface effects lower from place to place.
template <class All>
class ByPlace final : public All {
 public:
  template <class... Arguments>
  explicit ByPlace(SurfaceStage& places, const Arguments&... arguments) : All(arguments...), places_(places) {}
  std::string what() const override { return All::what() + "; from place to place, as the surface effects say"; }

 private:
  FrictionCoefficients coefficientsOf(const FingerTick& tick, std::int32_t body) const noexcept override {
    const FrictionCoefficients all = All::coefficientsOf(tick, body);
    const double share = places_.friction(tick, body);
    return {share * all.mu_static, share * all.mu_dynamic};
  }

  SurfaceStage& places_;
};

}  // namespace

std::unique_ptr<FrictionStage> makeFriction(const SurfacesInForce& surfaces, const Renderer& renderer,
                                            SurfaceStage* places) {
  if (places != nullptr) return std::make_unique<ByPlace<SteadyFriction>>(*places, surfaces, renderer);
  return std::make_unique<SteadyFriction>(surfaces, renderer);
}
std::unique_ptr<FrictionStage> makeChangingFriction(const SurfacesInForce& surfaces, const Renderer& renderer,
                                                    SurfaceStage* places, const In<SurfaceChange>& change) {
  if (places != nullptr) return std::make_unique<ByPlace<ChangingFriction>>(*places, surfaces, renderer, change);
  return std::make_unique<ChangingFriction>(surfaces, renderer, change);
}

}  // namespace presa
