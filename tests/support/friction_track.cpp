#include "tests/support/friction_track.h"

#include <limits>

#include "framework/haptics/friction_laws.h"
#include "tests/support/finger_world.h"

namespace presa::test {
namespace {

std::shared_ptr<const World> worldWith(const std::string& element, const FrictionTrack::Contact& contact) {
  const std::string scene = R"(<scene version="1.0" name="friction"><world gravity="0 0 0"/>
    <materials><material name="any" stiffness="1000"><friction static=")" +
                            std::to_string(contact.mu_static) + "\" dynamic=\"" + std::to_string(contact.mu_dynamic) +
                            "\">" + element + R"(</friction></material></materials>
    <body name="plane" fixed="true" material="any"><haptic><box size="1 1 1"/></haptic></body>
    <devices><device role="finger" fingertip_radius="0.008"/></devices></scene>)";
  return fingerWorld(scene);
}

}  // namespace

struct FrictionTrack::Parts {
  Parts(const std::string& element, const Contact& of)
      : world(worldWith(element, of)), laws(world->scene), contact(of) {}
  std::shared_ptr<const World> world;
  FrictionLaws laws;
  Contact contact;
  FrictionState state;
  Vec3 stretch = Vec3::Zero();
  bool fresh = true, slipping = false;
};

FrictionTrack::FrictionTrack(const std::string& element, const Contact& contact)
    : parts_(std::make_unique<Parts>(element, contact)) {}
FrictionTrack::~FrictionTrack() = default;

Vec3 FrictionTrack::slide(const Vec3& velocity) noexcept {
  Parts& p = *parts_;
  const Vec3 way = p.contact.period * Vec3(velocity.x(), velocity.y(), 0);
  const double depth = p.contact.normal_force / p.contact.stiffness;
  const FrictionAnswer answer =
      p.laws.of(0)->hold({p.contact.period, p.fresh, p.slipping, p.contact.mu_static, p.contact.mu_dynamic,
                          p.contact.stiffness, depth, Vec3::UnitZ(), p.stretch - way, way, Quat::Identity()},
                         p.state);
  p.fresh = false;
  p.stretch = answer.stretch;
  p.slipping = answer.slipping;
  if (!keepsContract(answer, depth)) return Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  return p.contact.stiffness * answer.stretch;
}

void FrictionTrack::press(double normal_force) noexcept { parts_->contact.normal_force = normal_force; }
bool FrictionTrack::slipping() const noexcept { return parts_->slipping; }

}  // namespace presa::test
