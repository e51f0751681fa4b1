#include <gtest/gtest.h>

#include <algorithm>

#include "tests/apps/support/support.h"
#include "tests/modules/haptics_proxy/surface/support/finger_rig.h"
#include "tests/modules/haptics_proxy/surface/support/mesh_files.h"
#include "tests/modules/haptics_proxy/surface/support/wanderer.h"

namespace presa::test {
namespace {

using Index = CollisionSettings::Index;

/// What a finger that wanders over a mesh feels, tick by tick. `stiff`: the force does not move the hand.
struct Felt {
  std::vector<Vec3> forces;
  int touching = 0;
};

Felt wander(const std::shared_ptr<const TriMesh>& mesh, const CollisionSettings& collision, bool stiff) {
  FingerRig rig(mesh, {.friction = 0.5, .collision = collision});
  Wanderer hand(*mesh, 7, stiff);
  Felt felt;
  Vec3 force = Vec3::Zero();
  for (int tick = 0; tick < 3000; ++tick) {
    const FingerContact& contact = rig.tick(hand.next(force));
    force = contact.f_H_W;
    felt.forces.push_back(force);
    felt.touching += contact.mode != ContactMode::kNone;
  }
  return felt;
}

class IndexForces : public testing::TestWithParam<std::string> {
 protected:
  std::shared_ptr<const TriMesh> mesh_ = std::make_shared<const TriMesh>(realMesh(GetParam()));
};

// The same triangles give the same cut, and the same cut the same forces to the bit, also where each force moves the
// hand on.
TEST_P(IndexForces, AreTheSameToTheBitUnderObbAndHcollide) {
  for (const double margin : {0.0, 0.002}) {
    const Felt obb = wander(mesh_, {.index = Index::kObb, .margin = margin}, false);
    EXPECT_GT(obb.touching, 300);
    EXPECT_EQ(wander(mesh_, {.index = Index::kHcollide, .margin = margin}, false).forces, obb.forces) << margin;
  }
}

// The cut of the tree alone has other nodes, from which the haptic tick comes to the same triangles in another order,
// as it does under another margin.
// Tolerance: the proxy's position to 1 um, which 1 N/mm turns into 1 mN, in every tick; rounding (1e-9 N) in 99 of 100.
TEST_P(IndexForces, AreThoseOfTheTree) {
  for (const double margin : {0.0, 0.002}) {
    const Felt tree = wander(mesh_, {.margin = margin}, true);
    EXPECT_GT(tree.touching, 300);
    for (const Index index : {Index::kObb, Index::kHcollide}) {
      const Felt other = wander(mesh_, {.index = index, .margin = margin}, true);
      std::vector<double> apart;
      for (std::size_t i = 0; i < tree.forces.size(); ++i) apart.push_back((other.forces[i] - tree.forces[i]).norm());
      std::ranges::sort(apart);
      EXPECT_LE(apart.back(), 1e-3) << margin;
      EXPECT_LE(apart[apart.size() * 99 / 100], 1e-9) << margin;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(OnMeshes, IndexForces, testing::Values("femur", "fandisk", "knot2"),
                         [](const auto& of) { return of.param; });

std::string explained(const std::string& index) {
  const Outcome outcome =
      presa("explain " + source("config/scenes/collision_index.xml") + " --set collision/index=" + index);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return outcome.out;
}

TEST(CollisionIndexScene, ExplainSaysWhichIndexSearches) {
  EXPECT_NE(explained("hcollide").find("index=\"hcollide\""), std::string::npos);
  EXPECT_NE(explained("obb").find("index=\"obb\""), std::string::npos);
  EXPECT_EQ(explained("tree").find("index=\""), std::string::npos);
}

TEST(CollisionIndexScene, FeelsTheSameUnderEachIndex) {
  const auto summaryOf = [](const std::string& index) {
    return runScene("config/scenes/collision_index.xml", {"collision/index=" + index})
        ->result()
        .contact_points.at(0)
        .summary;
  };
  const FingerSummary tree = summaryOf("tree");
  EXPECT_GT(tree.max_normal_force, 0.1);
  for (const std::string index : {"obb", "hcollide"}) {
    const FingerSummary other = summaryOf(index);
    EXPECT_EQ(other.pop_through, 0u) << index;
    EXPECT_EQ(other.slip_onsets, tree.slip_onsets) << index;
    EXPECT_NEAR(other.max_normal_force, tree.max_normal_force, 1e-9) << index;
    EXPECT_NEAR(other.mean_normal_force, tree.mean_normal_force, 1e-9) << index;
  }
}

}  // namespace
}  // namespace presa::test
