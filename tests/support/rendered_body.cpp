#include "tests/support/rendered_body.h"

#include <limits>

#include "framework/haptics/renderers.h"
#include "framework/haptics/surface_effects.h"
#include "tests/support/finger_world.h"

namespace presa::test {
namespace {

constexpr double kRadius = 0.008, kStiffness = 1000, kPeriod = 1e-3;

std::shared_ptr<const World> worldWith(const std::string& haptics, const std::string& shape, const std::string& effects,
                                       const std::string& material_effects) {
  return fingerWorld(R"(<scene version="1.0" name="rendered"><world gravity="0 0 0"/>)" + haptics +
                     R"(<materials><material name="any" stiffness="1000">)" + material_effects +
                     R"(</material><material name="other" stiffness="1000"/></materials>
    <body name="body" fixed="true" material="any"><haptic>)" +
                     shape + "</haptic>" + effects + R"(</body>
    <body name="elsewhere" fixed="true" material="other"/>
    <devices><device role="finger" fingertip_radius="0.008"/></devices></scene>)");
}

}  // namespace

struct RenderedBody::Parts {
  Parts(const std::string& haptics, const std::string& shape, const std::string& effects,
        const std::string& material_effects)
      : world(worldWith(haptics, shape, effects, material_effects)),
        renderer(makeRenderer(*world)),
        touchables(*world),
        near(touchables.meshCount()),
        surface(*world) {}
  std::shared_ptr<const World> world;
  std::unique_ptr<Renderer> renderer;
  Touchables touchables;
  Surroundings near;
  SurfaceEffects surface;
  BoundedList<RenderedContact> contacts{renderer->maxOwnContacts()};
  BodyHits hits{BodyHits::roomFor(1)};
  ProxyState proxy;
  Vec3 last_p_WH = Vec3::Zero();
  bool alive = false;
  double time = 0;  // [s]
};

RenderedBody::RenderedBody(const std::string& haptics, const std::string& shape, const std::string& effects,
                           const std::string& material_effects)
    : parts_(std::make_unique<Parts>(haptics, shape, effects, material_effects)) {}
RenderedBody::~RenderedBody() = default;
void RenderedBody::hear(const BodyHit& hit) noexcept { parts_->hits.add(hit); }

Vec3 RenderedBody::force(const Vec3& p_WH) noexcept {
  Parts& p = *parts_;
  if (!p.alive) p.proxy.x = p.proxy.god_object = p.last_p_WH = p_WH;
  p.alive = true;
  p.time += kPeriod;
  const double moved = (p_WH - p.last_p_WH).norm(), way = (p.proxy.god_object - p_WH).norm();
  p.last_p_WH = p_WH;
  p.touchables.surround(p.near, kNoBody, p_WH, way + 1.1 * kRadius, moved, kPeriod, nullptr);
  p.near.setStep(moved);
  const Pose X_WA;
  p.contacts.clear();
  ProxyContact contact = p.renderer->touch({0, p_WH, kRadius, p.proxy, X_WA, p.near, p.contacts});
  const Vec3 broken = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  if (!keepsContract(contact, p.contacts, p.touchables)) return broken;
  p.proxy = contact.state;
  if (!contact.state.touching) return Vec3::Zero();
  double softness = 1;
  if (p.surface.on(contact.body) &&
      !p.surface.act({0, p.time, kPeriod, kRadius, p_WH, contact, X_WA, p.touchables, p.near, &p.hits}, kStiffness,
                     contact, softness))
    return broken;
  return softness * kStiffness * (contact.depth * contact.nhat + contact.tangential_displacement);
}

}  // namespace presa::test
