// A minute of random grabbing in the temple's ruins.
#include <gtest/gtest.h>

#include <set>

#include "apps/common/scratch_folder.h"
#include "apps/temple/building/building.h"
#include "apps/temple/ruins.h"
#include "apps/temple/visit.h"
#include "apps/temple/written_scene.h"
#include "devices/clumsy_hand/clumsy_plan.h"
#include "tests/support/shipped_rig.h"

namespace presa::clumsy {
namespace {

const std::string kRig = PRESA_SOURCE_DIR "/config/rigs/clumsy_pair.xml";

/// The ruins of a column, for a pair of clumsy fingers.
std::string ruinsOfAColumn(const std::string& folder) {
  Diagnostics diagnostics;
  const temple::Building column = temple::makeBuilding(temple::shippedProportions("column", diagnostics), 0.1, 1);
  const temple::Ruins ruins =
      temple::strewRuins(column, 1, folder, [](std::size_t, std::size_t, const std::string&) { return true; });
  temple::SceneSpec spec = temple::assembled(column);
  for (temple::SceneSpec::Stone& stone : spec.stones) stone.X_WB = ruins.X_WB[stone.block];
  spec.to_be_built = true;
  spec.rig = kRig;
  return temple::writeScene(column, spec, folder);
}

temple::Rebuilt visited(const std::string& scene, std::uint64_t seed, double seconds) {
  Diagnostics diagnostics;
  RunOptions options;
  options.duration = seconds;
  options.seed = seed;
  Loaded loaded = loadWorld({scene, "", {}}, options, diagnostics);
  EXPECT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
  return temple::visit(std::move(loaded), {.quiet = true}).rebuilt;
}

// The transport watch, which every test runs under, ends the process on any force above a limit.
TEST(Clumsy, AMinuteOfItLosesNoBlock) {
  const ScratchFolder folder;
  const std::string scene = ruinsOfAColumn(folder.path().string());
  for (const std::uint64_t seed : {1, 2, 3}) {
    const temple::Rebuilt rebuilt = visited(scene, seed, 60);
    EXPECT_NEAR(rebuilt.simulated_seconds, 60, 0.01) << "to the end";
    EXPECT_EQ(rebuilt.lost, 0);
    EXPECT_LT(rebuilt.longest_outside, 20);
    EXPECT_EQ(rebuilt.faults, 0U);
    EXPECT_GT(rebuilt.mean_fingertip_depth, 1e-5) << "it did touch something";
    EXPECT_LT(rebuilt.mean_penetration, 0.2e-3);
  }
}

/// Runs a plan with motionless bodies; returns the phases of every action.
std::set<int> phasesOf(ClumsyPlan& plan, const ObjectState& objects, double seconds, double* fastest = nullptr) {
  std::set<int> seen;
  for (double time = 0; time < seconds; time += 1e-3) {
    plan.see(objects, time);
    seen.insert(plan.phase());
    if (fastest != nullptr) *fastest = std::max(*fastest, plan.rate(time).centre.norm());
    EXPECT_LE(plan.at(time).grip, ClumsyPlan::kMaxGrip);
  }
  return seen;
}

std::shared_ptr<const World> oneBlock() {
  World world;
  Body& body = world.scene.bodies.emplace_back();
  body.physics = Geometry{Box{{0.04, 0.04, 0.06}}, {}, {}};
  world.meshes.resize(1);
  return std::make_shared<const World>(world);
}

TEST(Clumsy, DoesEverythingAtABoundedSpeedAndTheSameForTheSameSeed) {
  ObjectState objects;
  objects.bodies.resize(1);
  ClumsyPlan one(oneBlock(), 0.008, 7), same(oneBlock(), 0.008, 7), other(oneBlock(), 0.008, 8);
  double fastest = 0;
  EXPECT_EQ(phasesOf(one, objects, 600, &fastest).size(), ClumsyPlan::phaseNames().size());
  EXPECT_LE(fastest, ClumsyPlan::kFastest);
  EXPECT_GT(fastest, 0.5 * ClumsyPlan::kFastest);
  phasesOf(same, objects, 600);
  phasesOf(other, objects, 600);
  EXPECT_EQ(one.at(600).centre, same.at(600).centre);
  EXPECT_NE(one.at(600).centre, other.at(600).centre);
}

TEST(Clumsy, ItsTickNeitherAllocatesNorLocks) {
  if (!RealTimeGuard::active()) GTEST_SKIP() << "the sanitizers own these functions";
  Diagnostics diagnostics;
  const auto device = test::firstDevice(PRESA_SOURCE_DIR "/config/scenes/cube.xml", kRig, diagnostics);
  ASSERT_TRUE(device) << diagnostics.text();
  ASSERT_TRUE(device->looks());
  ObjectState objects;
  objects.bodies.resize(2);
  const RealTimeGuard guard;
  for (std::uint64_t i = 0; i < 60000; ++i) {
    const Tick tick{i, static_cast<double>(i) * 1e-3, 1e-3};
    device->see(objects, tick);
    device->read(tick);
    device->write(Vec3(0.1, 0, 3.0 * static_cast<double>(i % 2)), tick);
  }
  EXPECT_EQ(guard.violations(), 0) << guard.first();
}

TEST(Clumsy, WithoutAnythingToTakeItIsRefused) {
  Diagnostics diagnostics;
  loadWorldFromText({"<scene version=\"1.0\" name=\"s\"><world gravity=\"0 0 -9.81\"/><materials><material name=\"m\" "
                     "stiffness=\"500\"/>"
                     "</materials><body name=\"a\" fixed=\"true\"><haptic><sphere radius=\"0.01\"/></haptic></body>"
                     "<devices><device role=\"thumb\"/></devices></scene>",
                     "s.xml", "<rig version=\"1.0\" name=\"r\"><device role=\"thumb\" driver=\"clumsy_hand\"/></rig>"},
                    {}, diagnostics);
  ASSERT_EQ(diagnostics.errorCount(), 1U) << diagnostics.text();
  EXPECT_EQ(diagnostics.all().front().code, 447);
}

}  // namespace
}  // namespace presa::clumsy
