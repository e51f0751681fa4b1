#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

#include "modules/god_object/god_object.h"
#include "tests/modules/haptics_proxy/module_fixture.h"

namespace presa {
namespace {

using test::kR;

const Pose kInPlace{};  // the mesh in its body

// A bumpy surface of triangles.
std::shared_ptr<const TriMesh> bumpyField(double edge = 1e-3, double reach = 0.02) {
  auto mesh = std::make_shared<TriMesh>();
  const int side = static_cast<int>(2 * reach / edge);
  for (int i = 0; i <= side; ++i) {
    for (int j = 0; j <= side; ++j) {
      const double x = i * edge - reach, y = j * edge - reach;
      mesh->vertices.emplace_back(x, y, 4e-4 * std::sin(900 * x) * std::cos(700 * y));
    }
  }
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      const int a = i * (side + 1) + j, b = a + side + 1;
      mesh->triangles.push_back({a, b, b + 1});
      mesh->triangles.push_back({a, b + 1, a + 1});
    }
  }
  return mesh;
}

double distanceFrom(const TriMesh& mesh, const Vec3& p) {
  double min = 1e300;
  for (const TriMesh::Triangle& t : mesh.triangles) {
    const auto at = [&](std::size_t i) -> const Vec3& { return mesh.vertices[static_cast<std::size_t>(t[i])]; };
    min = std::min(min, (p - closestOnTriangle(p, at(0), at(1), at(2))).norm());
  }
  return min;
}

// The history of the fronts must not affect the result: a fingertip that keeps its surroundings from tick to tick and
// one that rebuilds them move alike, with moving bodies, changing frames and cuts that end. Since the two process
// pieces in another order, they may differ by rounding.
TEST(Surroundings, WhatWasSeenBeforeChangesNothing) {
  const auto mesh = bumpyField();
  const MeshTree tree(mesh);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  auto kept = std::make_unique<Surroundings>();
  test::Tip tip{{0, 0, 0.01}, {0, 0, 0.01}};
  NearBody near;
  int touched = 0;
  Vec3 hand(0, 0, 0.0065), before = hand;
  for (std::uint64_t tick = 0; tick < 3000; ++tick) {
    hand += 4e-5 * Vec3(uniform(random), uniform(random), 0.3 * uniform(random));
    hand = hand.cwiseMax(Vec3(-2e-3, -2e-3, 0.005)).cwiseMin(Vec3(2e-3, 2e-3, 0.0085));
    if (tick % 10 == 0) {  // some cuts are too small
      near.center_B = tip.x;
      near.radius = 0.0115 + 0.003 * uniform(random);
      near.cut_count = static_cast<std::int32_t>(tree.cut(near.center_B, near.radius, near.cut));
    }
    // for a while the body moves in the working frame, as if the frame belonged to another body
    const double sway = tick / 500 % 2 == 0 ? 0 : 1e-5 * static_cast<double>(tick % 500);
    const Pose X_AG{Vec3(sway, 0, 0), Quat::Identity()};
    const bool own = tick / 1000 == 1;
    const auto fresh = std::make_unique<Surroundings>();
    test::Tip next[2] = {tip, tip};
    for (Surroundings* s : {kept.get(), fresh.get()}) {
      s->begin();
      s->setStep((hand - before).norm() + 2e-5);
      s->addMesh(0, tree, own ? nullptr : &X_AG, kInPlace, s == kept.get() ? &near : nullptr, hand, 0.012);
      ProxyContact contact = slideProxy(tip, hand, kR, *s);
      test::Tip& moved = next[s == kept.get() ? 0 : 1];
      test::holdByCone(contact, moved, hand, {0.4, 0.3}, *s);
      static_cast<ProxyState&>(moved) = contact.state;
    }
    ASSERT_NEAR((next[0].x - next[1].x).norm(), 0, 2e-6 * kR) << tick;
    ASSERT_NEAR((next[0].god_object - next[1].god_object).norm(), 0, 2e-6 * kR) << tick;
    ASSERT_EQ(next[0].touching, next[1].touching) << tick;
    tip = next[0];
    before = hand;
    touched += tip.touching;
  }
  EXPECT_GT(touched, 2000);
}

// A front finds every triangle within any distance, on a walk that makes it reseed many times. Oracle: all triangles.
TEST(MeshFront, FindsEveryTriangleWithinADistance) {
  const auto mesh = bumpyField(2e-3);
  const MeshTree tree(mesh);
  const std::array<std::int32_t, 1> root{MeshTree::kRoot};
  auto front = std::make_unique<MeshFront>();
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Vec3 p(0, 0, 0.005);
  int found_in_all = 0, seeds = 0;
  for (int step = 0; step < 2000; ++step) {
    p += 1e-3 * Vec3(uniform(random), uniform(random), uniform(random));
    p = p.cwiseMax(Vec3(-0.02, -0.02, -0.006)).cwiseMin(Vec3(0.02, 0.02, 0.006));
    if (!front->seeded() || front->worn()) {
      front->seed(tree, root, p);
      ++seeds;
    }
    const double limit = 0.003 * (1 + uniform(random));
    std::vector<std::int32_t> found, expected;
    front->focus(p, limit, 0);
    front->forEachWithin(p, limit, [&](int item, const Nearest& at) {
      found.push_back(tree.facet(front->facetOf(item)).id);
      EXPECT_LE(at.distance, limit);
    });
    for (std::size_t t = 0; t < mesh->triangles.size(); ++t) {
      const auto at = [&](std::size_t i) -> const Vec3& {
        return mesh->vertices[static_cast<std::size_t>(mesh->triangles[t][i])];
      };
      if ((p - closestOnTriangle(p, at(0), at(1), at(2))).norm() <= limit)
        expected.push_back(static_cast<std::int32_t>(t));
    }
    std::ranges::sort(found);
    ASSERT_EQ(found, expected) << step;
    found_in_all += static_cast<int>(found.size());
  }
  EXPECT_GT(found_in_all, 2000);
  EXPECT_GT(seeds, 5);
  EXPECT_FALSE(front->full());
}

// A segment between inside and outside of a closed surface crosses it, even exactly through edges and corners; a
// segment on one side does not. Oracle: a box, for which inside is known.
TEST(MeshFront, KnowsWhenASegmentCrosses) {
  const auto mesh = std::make_shared<const TriMesh>(makeBox({0.02, 0.02, 0.02}));
  const MeshTree tree(mesh);
  const std::array<std::int32_t, 1> root{MeshTree::kRoot};
  auto front = std::make_unique<MeshFront>();
  std::mt19937_64 random(4);
  std::uniform_int_distribution<int> grid(-3, 3);  // includes edges, corners and diagonals
  const auto inside = [](const Vec3& p) { return p.cwiseAbs().maxCoeff() < 0.01; };
  const auto onSurface = [](const Vec3& p) { return std::abs(p.cwiseAbs().maxCoeff() - 0.01) < 1e-9; };
  int changed = 0, clear = 0;
  for (int trial = 0; trial < 20'000; ++trial) {
    const auto point = [&]() -> Vec3 { return Vec3(grid(random), grid(random), grid(random)) * 0.005; };
    const Vec3 a = point(), b = point();
    if (onSurface(a) || onSurface(b)) continue;
    front->seed(tree, root, a);
    const bool crosses = front->crosses(std::array{a, b}, false);
    front->seed(tree, root, a);
    ASSERT_EQ(front->crosses(std::array{a, b, a}, false), crosses) << a << "\n" << b;  // there and back
    if (inside(a) != inside(b)) {
      ASSERT_TRUE(crosses) << a << "\n" << b;
      ++changed;
    } else if (inside(a)) {
      ASSERT_FALSE(crosses) << a << "\n" << b;  // the box is convex
    } else if ((a.array() * b.array()).maxCoeff() > 1e-4) {
      ASSERT_FALSE(crosses) << a << "\n" << b;  // both outside the same face
      ++clear;
    }
  }
  EXPECT_GT(changed, 1000);
  EXPECT_GT(clear, 1000);
}

// A spherical socket with the fingertip's own radius: every triangle is touched at once, more than the capacity. Nodes
// then act as solids: the fingertip stays inside, and lost coverage is reported.
TEST(Surroundings, AreFullWhereEverythingTouches) {
  TriMesh socket = makeSphere(kR, 5);  // 20 480 triangles
  turnInsideOut(socket);
  const MeshTree tree(std::make_shared<const TriMesh>(socket));
  auto s = std::make_unique<Surroundings>();
  ProxyState tip{Vec3::Zero(), Vec3::Zero()};
  for (int tick = 0; tick < 5; ++tick) {
    const Vec3 g(1e-4 * tick, 0, 5e-5 * tick);
    s->begin();
    s->setStep(2e-4);
    s->addMesh(0, tree, nullptr, kInPlace, nullptr, g, 0.01);
    tip = slideProxy(tip, g, kR * 0.9999, *s).state;
    ASSERT_LT(tip.x.norm(), 0.002) << tick;
    ASSERT_GT(distanceFrom(tree.mesh(), tip.x), 0.5 * kR) << tick;
  }
  EXPECT_TRUE(s->crowded());
}

}  // namespace
}  // namespace presa
