#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "framework/haptics/nearest_feasible.h"
#include "modules/god_object/god_object.h"
#include "tests/modules/haptics_proxy/module_fixture.h"
#include "tests/support/effort.h"

namespace presa {
namespace {

using test::kR, test::Tip;

// One tick as in the haptic loop with friction.
ProxyContact stepProxy(Tip& tip, const Vec3& g, Surroundings& s, const FrictionCoefficients& cone) {
  ProxyContact contact = slideProxy(tip, g, kR, s);
  test::holdByCone(contact, tip, g, cone, s);
  static_cast<ProxyState&>(tip) = contact.state;
  return contact;
}

void addTriangle(Surroundings& s, const Vec3& a, const Vec3& b, const Vec3& c, std::int32_t body = 0) {
  s.add({.body = body, .id = -1, .shape = PreparedTriangle(a, b, c)});
}

// A square plate of two triangles about the origin, in the plane z = 0.
std::unique_ptr<Surroundings> plate(double size = 0.2) {
  auto s = std::make_unique<Surroundings>();
  const double h = size / 2;
  addTriangle(*s, {-h, -h, 0}, {h, -h, 0}, {h, h, 0});
  addTriangle(*s, {-h, -h, 0}, {h, h, 0}, {-h, h, 0});
  return s;
}

std::unique_ptr<Surroundings> box(const Vec3& half, const Vec3& center = Vec3::Zero()) {
  auto s = std::make_unique<Surroundings>();
  Primitive primitive{.kind = Primitive::Kind::kBox, .X_AG = {}, .half = half};
  primitive.X_AG.p = center;
  s->add({.body = 0, .id = -1, .shape = primitive});
  return s;
}

// On a plane the god-object is the projection of the HIP, one fingertip radius above. Tolerance: rounding.
TEST(GodObject, IsTheProjectionOnAPlane) {
  const auto s = plate();
  const ProxyMove move = moveProxy({0.01, 0.02, 0.05}, {0.03, -0.01, -0.02}, kR, *s);
  EXPECT_TRUE(move.touching);
  EXPECT_NEAR((move.x - Vec3(0.03, -0.01, kR)).norm(), 0, 1e-8 * kR);
}

// The frictionless point went round a thin wall that still holds the proxy: contact begins anew in this tick, and its
// law gives the dynamics the bounds of it.
TEST(Friction, BoundsAContactThatBeginsBehindAWall) {
  const auto s = box({0.0005, 0.1, 0.1});
  Tip last({-0.0005 - kR, 0, 0}, {0.012, 0, 0});
  last.touching = true;
  const Vec3 g(0.02, 0, 0);
  ProxyContact contact = slideProxy(last, g, kR, *s);
  ASSERT_FALSE(contact.state.touching);
  const FrictionAnswer answer = test::holdByCone(contact, last, g, {0.8, 0.6}, *s);
  EXPECT_TRUE(contact.state.touching);
  EXPECT_NEAR(contact.x.x(), last.x.x(), 1e-8 * kR);
  EXPECT_EQ(answer.bound, 0.8);
  EXPECT_EQ(answer.bound_sliding, 0.6);
}

// On the ridge of a roof, with the HIP just below it, the fingertip leaves the ridge slowly at first, in short legs
// round the edge. When the legs run out, it is still in contact.
TEST(GodObject, IsInTouchWhenItsLegsRunOutOnARidge) {
  auto s = std::make_unique<Surroundings>();
  const double run = 0.01, fall = 0.0002;
  addTriangle(*s, {0, -0.1, 0}, {run, 0, -fall}, {0, 0.1, 0});
  addTriangle(*s, {0, -0.1, 0}, {0, 0.1, 0}, {-run, 0, -fall});
  for (const double off : {1e-5, 1e-4, 1e-3}) {
    const ProxyMove move = moveProxy({off * kR, 0, std::sqrt(1 - off * off) * kR}, {0, 0, -0.03 * kR}, kR, *s);
    EXPECT_TRUE(move.touching) << off;
    EXPECT_EQ(move.body, 0) << off;
    EXPECT_NEAR((move.x - Vec3(0, 0, -0.03 * kR)).norm(), 1.03 * kR, 0.001 * kR) << off;
  }
}

// Moving down a step gives the same answer at every scale: no tolerance is absolute.
TEST(GodObject, GivesTheSameAnswerAtEveryScale) {
  Vec3 unit = Vec3::Zero();
  for (const double scale : {1e-3, 1.0, 20.0}) {
    const auto s = plate(0.2 * scale);
    const ProxyMove move = moveProxy(scale * Vec3(0.01, 0.02, 0.05), scale * Vec3(0.03, -0.01, -0.02), scale * kR, *s);
    if (scale == 1e-3) unit = move.x / scale;
    EXPECT_NEAR((move.x / scale - unit).norm(), 0, 1e-8 * kR);
  }
}

// Contact means a gap within 1e-10 of the radius, at every size; a larger gap would hold the fingertip without contact.
// A micrometre of gap is no contact, and a micrometre of penetration is an overlap.
TEST(GodObject, TouchesWhatIsWithinTheRoundingOfItsRadius) {
  for (const double scale : {0.1, 1.0, 10.0}) {
    const double r = scale * kR;
    const auto s = plate(0.2 * scale);
    const auto supported = [&](double gap) {
      s->use(Point::kHeld);
      return isSupported({0.01 * scale, 0.02 * scale, r * (1 + gap)}, r, *s);
    };
    EXPECT_TRUE(supported(0)) << scale;
    EXPECT_TRUE(supported(5e-11)) << scale;
    EXPECT_TRUE(supported(-5e-11)) << scale;
    for (const double gap : {1e-9, 1e-6, 1e-5, 5e-5}) {
      EXPECT_FALSE(supported(gap)) << scale << ' ' << gap;
      EXPECT_FALSE(supported(-gap)) << scale << ' ' << gap;
    }
  }
}

// A V-groove of any opening angle: two faces hold the fingertip at (0, r / sin(half angle)).
TEST(GodObject, RestsInAGrooveOnBothFaces) {
  for (const double degrees : {30.0, 60.0, 90.0, 120.0, 160.0}) {
    const double half = degrees / 2 * std::numbers::pi / 180;
    const Vec3 left(-0.3 * std::sin(half), 0, 0.3 * std::cos(half)), right(-left.x(), 0, left.z());
    Surroundings s;
    const Vec3 front(0, -0.1, 0), back(0, 0.1, 0);
    addTriangle(s, front, left + front, left + back);
    addTriangle(s, front, left + back, back);
    addTriangle(s, front, back, right + back);
    addTriangle(s, front, right + back, right + front);
    const ProxyMove move = moveProxy({0.001, 0.01, 0.25}, {0.0005, 0.02, -0.02}, kR, s);
    EXPECT_NEAR(move.x.x(), 0, 1e-6) << degrees;
    EXPECT_NEAR(move.x.z(), kR / std::sin(half), 1e-6) << degrees;
    EXPECT_NEAR(move.x.y(), 0.02, 1e-6) << degrees;
  }
}

// Oracle for a convex solid: the god-object is the point of the offset surface nearest to the HIP; for a HIP just
// inside a sphere it lies on the ray from the centre. Iterates to 1e-6 of the radius.
TEST(GodObject, FindsTheNearestPointOfASphere) {
  Surroundings s;
  const Primitive sphere{.kind = Primitive::Kind::kSphere, .X_AG = {}, .half = Vec3::Zero(), .radius = 0.04};
  s.add({.body = 0, .id = -1, .shape = sphere});
  Vec3 x(0, 0, 0.1);
  const Vec3 g = 0.042 * Vec3(0.3, 0.1, 1).normalized();
  for (int tick = 0; tick < 3; ++tick) x = moveProxy(x, g, kR, s).x;
  EXPECT_NEAR((x - 0.048 * g.normalized()).norm(), 0, 1e-6 * kR);
}

// At any speed and angle the fingertip never gets through a 0.5 mm plate.
TEST(GodObject, NeverPassesAThinPlate) {
  const auto s = box({0.1, 0.1, 0.00025});
  for (const double speed : {0.01, 0.1, 1.0, 10.0, 100.0}) {
    for (double angle = 0; angle < 1.4; angle += 0.1) {
      const Vec3 step = speed * 1e-3 * Vec3(std::sin(angle), 0, -std::cos(angle));
      Vec3 x(0, 0, 0.02), g = x;
      for (int tick = 0; tick < 200 && g.norm() < 0.08; ++tick) {
        g += step;
        x = moveProxy(x, g, kR, *s).x;
        ASSERT_GE(nearest(s->primitive(0), x).distance, kR * (1 - 1e-6)) << speed << ' ' << angle;
        ASSERT_GT(x.z(), 0);
      }
    }
  }
}

// At a convex edge the proxy moves round the edge, not through it.
TEST(GodObject, GoesRoundTheEdgeOfABox) {
  const auto s = box({0.05, 0.05, 0.05});
  Vec3 x(0, 0, 0.05 + kR), g(0, 0, 0.055);
  for (int tick = 0; tick < 80; ++tick) {
    g += Vec3(0.001, 0, 0);  // sideways past the edge at x = 0.05
    if (g.x() > 0.056) g.z() -= 0.002;
    x = moveProxy(x, g, kR, *s).x;
    ASSERT_GE(nearest(s->primitive(0), x).distance, kR * (1 - 1e-6));
  }
  EXPECT_NEAR((x - g).norm(), 0, 1e-9);  // it is free again
}

// Without friction there is no tangential force, at any depth and speed: the noise floor of every friction study.
TEST(Friction, FrictionlessSlidingHasNoTangentialForce) {
  const auto s = plate();
  Vec3 x(-0.05, 0, 0.02);
  Tip tip{x, x};
  for (int tick = 0; tick < 500; ++tick) {
    const Vec3 g(-0.05 + 2e-4 * tick, 1e-5 * tick, 0.006);
    const ProxyContact c = stepProxy(tip, g, *s, {});
    ASSERT_TRUE(tip.touching);
    ASSERT_LT(c.tangential_displacement.norm(), 1e-8 * kR);
  }
}

// The two-state cone of the PERCRO paper holds up to mu_s and slides at mu_d, equally in every direction.
TEST(Friction, HoldsUpToStaticAndSlidesAtDynamicInEveryDirection) {
  const auto s = plate();
  const FrictionCoefficients cone{0.8, 0.6};
  for (double heading = 0; heading < 6.28; heading += 0.4) {
    const Vec3 along(std::cos(heading), std::sin(heading), 0);
    const double depth = 0.002;
    Tip tip{{0, 0, kR}, {0, 0, kR}};
    double max = 0, sliding = 0;
    for (int tick = 0; tick < 400; ++tick) {
      const Vec3 g = Vec3(0, 0, kR - depth) + along * (1e-5 * tick);
      const ProxyContact c = stepProxy(tip, g, *s, cone);
      const double ratio = c.tangential_displacement.norm() / c.depth;
      if (!tip.slipping) max = std::max(max, ratio);
      if (tip.slipping) sliding = ratio;
    }
    EXPECT_NEAR(max, 0.8, 1.001e-5 / depth) << heading;  // within one step of the motion, plus rounding
    EXPECT_NEAR(sliding, 0.6, 1e-6) << heading;
  }
}

// Slipping along a cylinder after a displacement around it: the tangential displacement turns into the direction of
// motion like the end of a dragged rope (tractrix), tan(phi / 2) = tan(phi_0 / 2) exp(-way / (mu depth)), at every
// rate. Error of Euler's step: step / (2 L).
TEST(Friction, TurnsAsATractrixOnACurvedSurfaceAtEveryRate) {
  const double radius = 0.02, depth = 0.004, mu = 0.5, length = mu * depth;
  for (const double step : {1e-4, 1e-5, 1e-6}) {
    Surroundings s;
    s.add({.body = 0,
           .id = -1,
           .shape = Primitive{.kind = Primitive::Kind::kCylinder,
                              .X_AG = {},
                              .half = Vec3::Zero(),
                              .radius = radius,
                              .half_length = 0.1}});
    Tip tip{{radius + kR, 0, 0}, {radius + kR, 0, 0}};
    const double inside = radius + kR - depth;
    ProxyContact c = stepProxy(tip, {inside, 0, 0}, s, {mu, mu});
    for (double around = 0; around < 0.01; around += 2e-5) {
      c = stepProxy(tip, {inside * std::cos(around / inside), -inside * std::sin(around / inside), 0}, s, {mu, mu});
    }
    const Vec3 from(inside * std::cos(0.01 / inside), -inside * std::sin(0.01 / inside), 0);
    const double phi_0 = std::numbers::pi / 2, way = 0.003;
    for (double along = step; along < way + 0.5 * step; along += step) {
      c = stepProxy(tip, from + Vec3(0, 0, along), s, {mu, mu});
      ASSERT_TRUE(c.state.slipping);
    }
    const double phi = 2 * std::atan(std::tan(phi_0 / 2) * std::exp(-way / length));
    const Vec3 displacement = tip.held.anchor - (from + Vec3(0, 0, way));
    const double seen = std::acos(std::clamp(-displacement.z() / displacement.norm(), -1.0, 1.0));
    EXPECT_NEAR(seen, phi, 0.01 + step / length) << step;
  }
}

// A sticking finger does not creep: after a minute of shaking inside the cone the proxy is unchanged to the bit.
TEST(Friction, StickingProxyDoesNotDrift) {
  const auto s = plate();
  const FrictionCoefficients cone{0.8, 0.6};
  Tip tip{{0, 0, kR}, {0, 0, kR}};
  Vec3 first = Vec3::Zero();
  for (int tick = 0; tick < 60'000; ++tick) {
    const double t = tick * 1e-3;
    const Vec3 g(4e-4 * std::sin(7 * t), 4e-4 * std::sin(11 * t), kR - 0.002 + 2e-4 * std::sin(5 * t));
    stepProxy(tip, g, *s, cone);
    if (tick == 0) first = tip.x;
    ASSERT_FALSE(tip.slipping);
  }
  EXPECT_EQ(tip.x, first);
}

// The proxy sticks to a wall, above a floor into which its HIP is pressed as well; then the wall disappears. The proxy,
// now in free air, must come down to the floor in the same tick. Oracle: the distance from the floor.
TEST(Friction, LetsGoOfABodyThatHasGone) {
  const FrictionCoefficients cone{0.8, 0.6};
  const double high = 0.0005;  // height of the sticking proxy above its position on the floor [m]
  const auto surroundings = [](bool wall) {
    auto s = box({0.2, 0.2, 0.05}, {0, 0, -0.05});
    Primitive standing{.kind = Primitive::Kind::kBox, .X_AG = {}, .half = {0.05, 0.2, 0.2}};
    standing.X_AG.p = {-0.05, 0, 0.15};
    if (wall) s->add({.body = 1, .id = -1, .shape = standing});
    return s;
  };
  const auto both = surroundings(true), floor = surroundings(false);
  Tip tip{{kR + 0.001, 0, kR + high}, {kR + 0.001, 0, kR + high}};
  stepProxy(tip, {kR - 0.001, 0, kR + high}, *both, cone);
  const Vec3 g(kR - 0.001, 0, kR - 0.005);
  stepProxy(tip, g, *both, cone);
  ASSERT_FALSE(tip.slipping);
  ASSERT_NEAR(tip.x.z(), kR + high, 1e-8 * kR);

  const ProxyContact contact = stepProxy(tip, g, *floor, cone);
  EXPECT_TRUE(contact.state.touching);
  EXPECT_NEAR(contact.x.z(), kR, 1e-6 * kR);
  EXPECT_LE(contact.tangential_displacement.norm(), cone.mu_static * contact.depth * (1 + 1e-9));
}

// Two boxes move about a fingertip in the wedge between them, also round its edges: a touching proxy must lie on a
// surface, whatever friction held on to before. Tolerance 1e-4 r: accuracy of the last leg round an edge when the HIP
// is almost a radius deep.
TEST(Friction, ATouchingProxyIsOnASurfaceWhateverMoves) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  Tip tip{{0.03, 0, 0.03}, {0.03, 0, 0.03}};
  Vec3 g = tip.x, wall(-0.02, 0, 0.02), post(0.02, 0, -0.02);
  int touching = 0, stuck = 0;
  for (int tick = 0; tick < unlessSanitized(20'000, 5'000); ++tick) {
    if (tick % 50 == 0) {
      wall = Vec3(-0.02, 0, 0.02) + 0.002 * Vec3(unit(random), unit(random), unit(random));
      post = Vec3(0.02, 0, -0.02) + 0.002 * Vec3(unit(random), unit(random), unit(random));
    }
    auto s = box({0.02, 0.02, 0.02}, wall);
    Primitive second{.kind = Primitive::Kind::kBox, .X_AG = {}, .half = {0.02, 0.02, 0.02}};
    second.X_AG.p = post;
    s->add({.body = 1, .id = -1, .shape = second});
    g += 3e-4 * Vec3(unit(random), unit(random), unit(random));
    g = g.cwiseMax(Vec3(-0.002, -0.025, -0.002)).cwiseMin(Vec3(0.015, 0.025, 0.015));
    stepProxy(tip, g, *s, {0.8, 0.6});
    if (!tip.touching) continue;
    ++touching;
    stuck += tip.slipping ? 0 : 1;
    const double off =
        std::min(nearest(s->primitive(0), tip.x).distance, nearest(s->primitive(1), tip.x).distance) - kR;
    ASSERT_LE(off, 1e-4 * kR) << tick;
  }
  EXPECT_GT(touching, unlessSanitized(5000, 1250));
  EXPECT_GT(stuck, unlessSanitized(1000, 250));
}

// Brute force: no feasible sample is nearer to the goal than the solution of the programme.
TEST(NearestFeasible, BeatsEveryFeasibleSample) {
  std::uint64_t seed = 88172645463325252ull;
  const auto uniform = [&seed] {
    seed ^= seed << 13, seed ^= seed >> 7, seed ^= seed << 17;
    return static_cast<double>(seed >> 11) / 9007199254740992.0 * 2 - 1;
  };
  for (int trial = 0; trial < 300; ++trial) {
    HalfSpaces half_spaces;
    const Vec3 inside(uniform(), uniform(), uniform());
    for (int i = 0; i < 6; ++i) {
      const Vec3 nhat = Vec3(uniform(), uniform(), uniform()).normalized();
      half_spaces.add({nhat, nhat.dot(inside) - 0.2 * std::abs(uniform()), i}, inside);
    }
    const Vec3 g = 3 * Vec3(uniform(), uniform(), uniform());
    const Feasible answer = nearestFeasible(half_spaces, g);
    const auto feasible = [&](const Vec3& y, double slack) {
      for (int i = 0; i < half_spaces.count; ++i) {
        const auto& h = half_spaces.item[static_cast<std::size_t>(i)];
        if (h.nhat.dot(y) < h.offset - slack) return false;
      }
      return true;
    };
    ASSERT_TRUE(feasible(answer.y, 1e-8)) << trial;
    for (int sample = 0; sample < 300; ++sample) {
      const double reach = sample < 150 ? 0.05 : 1;
      const Vec3 y = answer.y + reach * Vec3(uniform(), uniform(), uniform());
      if (!feasible(y, 0)) continue;
      ASSERT_GE((y - g).norm(), (answer.y - g).norm() - 1e-8);
    }
  }
}

}  // namespace
}  // namespace presa
