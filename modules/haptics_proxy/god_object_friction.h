#pragma once
// Second half of god_object.h.

namespace presa {

template <class ConeOf>
ProxyContact stepProxy(const Vec3& x, const Vec3& g, double r, bool was_touching, bool was_slipping,
                       Surroundings& surroundings, const ConeOf& cone_of) noexcept {
  ProxyContact contact;
  const ProxyMove bare = moveProxy(x, g, r, surroundings);
  contact.x = bare.x;
  contact.covered = bare.covered;
  const double depth = (bare.x - g).norm();
  if (!bare.touching || !(depth > 0)) return contact;

  contact.touching = true;
  contact.body = bare.body;
  contact.nhat = (bare.x - g) / depth;

  // the base of the cone is the frictionless proxy, its apex the HIP, its radius mu * depth;
  // what friction holds on to is the old proxy, or the point of first touch
  const FrictionCone cone = cone_of(bare.body);
  const Vec3 held = was_touching ? x : bare.first_touch;
  Vec3 stretch = held - bare.x;
  stretch -= stretch.dot(contact.nhat) * contact.nhat;
  const double length = stretch.norm();
  const double mu = was_touching && was_slipping ? cone.mu_dynamic : cone.mu_static;
  contact.slipping = length > mu * depth;
  if (contact.slipping) stretch *= cone.mu_dynamic * depth / length;

  // what sticks does not move at all: it lives in the body's coordinates, so there is no drift to correct
  if (!contact.slipping && isClear(held, r, surroundings)) {
    contact.x = held;
  } else {
    // the border of the cone is reached along the surface: move the goal sideways, and go there
    const ProxyMove moved = moveProxy(held, g + stretch, r, surroundings);
    contact.x = moved.x;
    contact.covered = contact.covered && moved.covered;
  }
  const Vec3 away = contact.x - g;
  contact.depth = away.dot(contact.nhat);
  contact.stretch = away - contact.depth * contact.nhat;
  return contact;
}

}  // namespace presa
