#include "tests/support/rendered_body.h"

#include <limits>

#include "framework/haptics/renderers.h"
#include "tests/support/finger_world.h"

namespace presa::test {
namespace {

constexpr double kRadius = 0.008, kStiffness = 1000, kPeriod = 1e-3;

std::shared_ptr<const World> worldWith(const std::string& haptics, const std::string& shape) {
  return fingerWorld(R"(<scene version="1.0" name="rendered"><world gravity="0 0 0"/>)" + haptics +
                     R"(<materials><material name="any" stiffness="1000"/></materials>
    <body name="body" fixed="true" material="any"><haptic>)" +
                     shape + R"(</haptic></body>
    <devices><device role="finger" fingertip_radius="0.008"/></devices></scene>)");
}

}  // namespace

struct RenderedBody::Parts {
  Parts(const std::string& haptics, const std::string& shape)
      : world(worldWith(haptics, shape)),
        renderer(makeRenderer(*world)),
        touchables(*world),
        near(touchables.meshCount()) {}
  std::shared_ptr<const World> world;
  std::unique_ptr<Renderer> renderer;
  Touchables touchables;
  Surroundings near;
  ProxyState proxy;
  Vec3 last_p_WH = Vec3::Zero();
  bool alive = false;
};

RenderedBody::RenderedBody(const std::string& haptics, const std::string& shape)
    : parts_(std::make_unique<Parts>(haptics, shape)) {}
RenderedBody::~RenderedBody() = default;

Vec3 RenderedBody::force(const Vec3& p_WH) noexcept {
  Parts& p = *parts_;
  if (!p.alive) p.proxy.x = p.proxy.god_object = p.last_p_WH = p_WH;
  p.alive = true;
  const double moved = (p_WH - p.last_p_WH).norm(), way = (p.proxy.god_object - p_WH).norm();
  p.last_p_WH = p_WH;
  p.touchables.surround(p.near, kNoBody, p_WH, way + 1.1 * kRadius, moved, kPeriod, nullptr);
  p.near.setStep(moved);
  const Pose X_WA;
  const ProxyContact contact = p.renderer->touch({0, p_WH, kRadius, p.proxy, X_WA, p.near});
  if (!keepsContract(contact, p.touchables)) return Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  p.proxy = contact.state;
  return kStiffness * contact.depth * contact.nhat;
}

}  // namespace presa::test
