#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

#include "modules/haptics_proxy/god_object.h"

namespace presa {
namespace {

// A bumpy field of triangles and their bounds.
struct Field {
  explicit Field(double edge = 1e-3, double reach = 0.011) {
    const auto corner = [](double x, double y) { return Vec3(x, y, 4e-4 * std::sin(900 * x) * std::cos(700 * y)); };
    for (double x = -reach; x < reach; x += edge) {
      for (double y = -reach; y < reach; y += edge) {
        add(corner(x, y), corner(x + edge, y), corner(x + edge, y + edge));
        add(corner(x, y), corner(x + edge, y + edge), corner(x, y + edge));
      }
    }
  }
  void add(const Vec3& a, const Vec3& b, const Vec3& c) {
    PatchTriangle triangle{};
    triangle.v_B = {a, b, c};
    triangles.push_back(triangle);
    bounds.push_back(boundOf(triangle.v_B));
  }
  // Only what lies within `radius` of `center`, as the collision thread would deliver it.
  Field around(const Vec3& center, double radius) const {
    Field part(1, 0);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const auto& v = triangles[t].v_B;
      if ((center - closestOnTriangle(center, v[0], v[1], v[2])).norm() > radius) continue;
      part.triangles.push_back(triangles[t]);
      part.bounds.push_back(bounds[t]);
    }
    return part;
  }
  std::vector<PatchTriangle> triangles;
  std::vector<BoundingSphere> bounds;
};

// What earlier ticks looked at must not be felt: a fingertip that keeps its surroundings from tick to tick and one that
// looks at everything anew go the same way to the bit, over patches that change, bodies that move, and frames that switch.
TEST(Surroundings, WhatWasPickedBeforeChangesNothing) {
  const Field field;  // wider than anything the fingertip reaches
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  auto kept = std::make_unique<Surroundings>();
  FingertipState tip{{0, 0, 0.01}, {0, 0, 0.01}}, fresh_tip = tip;
  Field patch = field.around(tip.x, 0.014);
  Surroundings::Cover cover{tip.x, 0.014};
  int touched = 0;
  Vec3 hand(0, 0, 0.0065);
  for (std::uint64_t tick = 0; tick < 3000; ++tick) {
    hand += 4e-5 * Vec3(uniform(random), uniform(random), 0.3 * uniform(random));
    hand = hand.cwiseMax(Vec3(-2e-3, -2e-3, 0.005)).cwiseMin(Vec3(2e-3, 2e-3, 0.0085));
    if (tick % 10 == 0) {
      cover = {tip.x, 0.0115 + 0.001 * uniform(random)};
      patch = field.around(cover.center, cover.radius);
    }
    // for a while the body moves in the working frame, as a body does that is not the frame's own
    const double sway = tick / 500 % 2 == 0 ? 0 : 1e-5 * static_cast<double>(tick % 500);
    const Pose X_AB{Vec3(sway, 0, 0), Quat::Identity()};
    const std::int32_t frame = tick / 1000 == 1 ? 0 : kNoBody;
    const auto fresh = std::make_unique<Surroundings>();
    for (Surroundings* s : {kept.get(), fresh.get()}) {
      FingertipState& state = s == kept.get() ? tip : fresh_tip;
      s->begin(frame, tick / 10);
      s->addTriangles(patch.triangles.data(), patch.bounds.data(), static_cast<int>(patch.triangles.size()), 0,
                      frame == 0 ? nullptr : &X_AB, cover);
      ProxyContact contact = slideProxy(state, hand, 0.008, *s);
      holdByFriction(contact, state, hand, 0.008, {0.4, 0.3}, *s);
      state = contact.state;
    }
    ASSERT_EQ(tip.x, fresh_tip.x) << tick;
    ASSERT_EQ(tip.god, fresh_tip.god) << tick;
    touched += tip.touching;
  }
  EXPECT_GT(touched, 2000);
}

}  // namespace
}  // namespace presa
