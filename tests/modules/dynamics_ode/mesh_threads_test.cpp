#include <thread>

#include "tests/framework/geometry/hollow_meshes.h"
#include "tests/modules/dynamics_ode/support.h"
#include "tests/support/effort.h"

// ODE's cache for meshes is one for all threads of the process.
namespace presa::ode {
namespace {

/// A cup that is not convex, and balls that rattle in it.
std::vector<Vec3> whereBallsEnd(int seed) {
  constexpr double kRadius = 0.01;
  const auto cup = std::make_shared<TriMesh>(test::cup(24, 0.04, 0.044, 0.004, 0.06));
  WorldMaker maker;
  maker.add(MeshRef{}, Pose{}, {}, {}, cup);
  for (int ball = 0; ball < 4; ++ball) {
    const Vec3 p(0.02 * std::cos(seed + 1.6 * ball), 0.02 * std::sin(seed + 1.6 * ball), 0.03);
    maker.add(Sphere{kRadius}, {p, Quat::Identity()}, {0.01, Vec3::Zero(), Mat3::Identity() * 4e-7});
  }
  OdeOptions options;
  options.method.sleeping = false;
  Runner runner(maker.world(), options);
  runner.run(unlessSanitized(10, 1));
  std::vector<Vec3> ends;
  for (std::size_t ball = 1; ball <= 4; ++ball) ends.push_back(runner[ball].X_WB_end.p);
  return ends;
}

TEST(MeshesOnSeveralThreads, MoveAsOnOne) {
  constexpr int kThreads = 4;
  std::vector<std::vector<Vec3>> together(kThreads);
  std::vector<std::thread> threads;
  for (int seed = 0; seed < kThreads; ++seed)
    threads.emplace_back([&, seed] { together[static_cast<std::size_t>(seed)] = whereBallsEnd(seed); });
  for (std::thread& thread : threads) thread.join();
  for (int seed = 0; seed < kThreads; ++seed)
    EXPECT_EQ(together[static_cast<std::size_t>(seed)], whereBallsEnd(seed)) << seed;
}

}  // namespace
}  // namespace presa::ode
