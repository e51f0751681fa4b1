#pragma once
#include <gtest/gtest.h>

#include <memory>

#include "framework/core/graph/graph_builder.h"
#include "modules/god_object/god_object.h"
#include "modules/haptics_proxy/friction.h"
#include "modules/haptics_proxy/haptics_proxy.h"

namespace presa::test {

inline constexpr double kR = 0.008;         // radius of the fingertip [m]
inline constexpr double kStiffness = 1000;  // of the surface [N/m]

/// A fingertip from tick to tick, as friction and the god-object keep it.
struct Tip : ProxyState {
  Tip(const Vec3& at, const Vec3& free) : ProxyState{at, free, false, false} {}
  Held held;
};

/// Friction with the default law and the proxy of the god-object. Does not write the tip's ProxyState.
inline FrictionAnswer holdByCone(ProxyContact& contact, Tip& tip, const Vec3& g, const FrictionCoefficients& cone,
                                 Surroundings& surroundings) {
  static const auto kLaw = pluginTable<FrictionLawPlugin>(kDefaultFrictionLaw, "presaFrictionLawPlugin").create({});
  static const auto kRenderer = pluginTable<RendererPlugin>("god_object", "presaRendererPlugin").create({}, World{});
  struct One final : Friction {
    explicit One(const BodyLaw& law) : Friction(kStiffness, 1e-3), with(law) {}
    BodyLaw of(std::int32_t) const noexcept override { return with; }
    BodyLaw with;
  };
  EXPECT_EQ(holdByFriction(contact, {}, tip, tip.held, g, kR, One({kLaw.get(), cone.mu_static, cone.mu_dynamic}),
                           *kRenderer->mover(), surroundings),
            kNoBody);
  return tip.held.bodies.empty() ? FrictionAnswer{} : tip.held.bodies[0].answer;
}

/// Publishes a value set by the test, at haptic rate, so that the module under test reads it in the same tick.
template <class T>
struct Source final : Module {
  explicit Source(const char* port) : Module(std::string("source_of_") + port, RateGroup::kHaptic), out(*this, port) {}
  void step(const Tick&) noexcept override {}
  Out<T> out;
};

struct Sink final : Module {
  Sink() : Module("sink", RateGroup::kHaptic) {}
  void step(const Tick&) noexcept override {}
  In<ContactExchange> contact{*this, "contact_exchange"};
};

/// One finger in a world, rendered by the module in a graph.
class OneFinger {
 public:
  explicit OneFinger(World world, const RunOptions& options = {}) : world_(indexed(std::move(world))) {
    build(effectsOf(*world_, options));
  }
  OneFinger(World world, const HapticEffects& effects) : world_(indexed(std::move(world))) { build(effects); }

  const FingerContact& tick(const Vec3& p_WH, const Vec3& v_WH = Vec3::Zero(), double time = 0) {
    return tick(FingerInput{p_WH, v_WH, -1, true}, time);
  }
  const FingerContact& tick(const FingerInput& input, double time = 0) {
    device_->out.value.fingers[0] = input;
    graph_.step(RateGroup::kHaptic, {index_++, time, 1e-3});
    return sink_->contact->fingers[0];
  }
  FingerNeighbourhoods& neighbourhoods() { return neighbourhoods_->out.value; }
  SurfaceChange& surfaces() { return surfaces_->out.value; }
  SurfaceSettings& settings() { return settings_->out.value; }
  ObjectState& objects() { return objects_->out.value; }
  const ContactExchange& all() const { return sink_->contact.value(); }
  std::vector<std::string> stages() const { return graph_.find("haptics_proxy")->stages(); }

 private:
  static std::shared_ptr<const World> indexed(World world) {
    indexHapticMeshes(world);
    return std::make_shared<const World>(std::move(world));
  }
  void build(const HapticEffects& effects) {
    GraphBuilder builder;
    device_ = &builder.add(std::make_unique<Source<DeviceState>>("device_state"));
    device_->out.value = DeviceState(1);
    neighbourhoods_ = &builder.add(std::make_unique<Source<FingerNeighbourhoods>>("contact_patches"));
    neighbourhoods_->out.value.fingers.resize(1);
    surfaces_ = &builder.add(std::make_unique<Source<SurfaceChange>>("surface_change"));
    settings_ = &builder.add(std::make_unique<Source<SurfaceSettings>>("surface_settings"));
    objects_ = &builder.add(std::make_unique<Source<ObjectState>>("object_state"));
    objects_->out.value.bodies.resize(world_->scene.bodies.size());
    for (std::size_t b = 0; b < world_->scene.bodies.size(); ++b) {
      objects_->out.value.bodies[b].X_WB_begin = objects_->out.value.bodies[b].X_WB_end = world_->scene.bodies[b].X_WB;
    }
    builder.add(std::make_unique<HapticsProxy>(world_, effects));
    sink_ = &builder.add(std::make_unique<Sink>());
    builder.connectByName();
    graph_ = builder.build();
  }

  std::shared_ptr<const World> world_;
  Graph graph_;
  Source<DeviceState>* device_ = nullptr;
  Source<FingerNeighbourhoods>* neighbourhoods_ = nullptr;
  Source<SurfaceChange>* surfaces_ = nullptr;
  Source<SurfaceSettings>* settings_ = nullptr;
  Source<ObjectState>* objects_ = nullptr;
  Sink* sink_ = nullptr;
  std::uint64_t index_ = 0;
};

/// A body of 1000 N/m touched by a fingertip of 8 mm, without friction or damping.
inline World worldOf(const Shape& shape, bool fixed = true) {
  World world;
  world.scene.materials.resize(1);
  world.scene.materials[0].stiffness = 1000;
  Body body;
  body.name = "body";
  body.fixed = fixed;
  body.haptic = Geometry{shape, {}, {}};
  world.scene.bodies = {body};
  world.scene.devices.resize(1);
  world.meshes.resize(1);
  world.inertias.resize(1);
  return world;
}

}  // namespace presa::test
