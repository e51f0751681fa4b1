#pragma once
// Second half of god_object.h.

namespace presa {

template <class ConeOf>
ProxyContact stepProxy(const FingertipState& last, const Vec3& g, double r, Surroundings& surroundings,
                       const ConeOf& cone_of) noexcept {
  ProxyContact contact;
  // the frictionless point goes on from where it was: it has little way to go, whatever friction holds back
  const ProxyMove bare = moveProxy(last.god, g, r, surroundings);
  contact.state.x = contact.state.god = bare.x;
  contact.covered = bare.covered;
  const double depth = (bare.x - g).norm();
  if (!bare.touching || !(depth > 0)) return contact;

  contact.state.touching = true;
  contact.body = bare.body;
  contact.nhat = (bare.x - g) / depth;

  // the base of the cone is the frictionless point, its apex the HIP, its radius mu * depth;
  // what friction holds on to is the old proxy, or the point of first touch
  const FrictionCone cone = cone_of(bare.body);
  const Vec3 held = last.touching ? last.x : bare.first_touch;
  Vec3 stretch = held - bare.x;
  stretch -= stretch.dot(contact.nhat) * contact.nhat;
  const double length = stretch.norm();
  const double mu = last.touching && last.slipping ? cone.mu_dynamic : cone.mu_static;
  contact.state.slipping = length > mu * depth;
  if (contact.state.slipping) stretch *= cone.mu_dynamic * depth / length;

  // what sticks does not move at all: it lives in the body's coordinates, so there is no drift to correct
  if (!contact.state.slipping && isClear(held, r, surroundings)) {
    contact.state.x = held;
  } else {
    // the border of the cone is reached along the surface: move the goal sideways, and go there
    const ProxyMove moved = moveProxy(held, g + stretch, r, surroundings);
    contact.state.x = moved.x;
    contact.covered = contact.covered && moved.covered;
  }
  const Vec3 away = contact.state.x - g;
  contact.depth = away.dot(contact.nhat);
  contact.stretch = away - contact.depth * contact.nhat;
  return contact;
}

}  // namespace presa
