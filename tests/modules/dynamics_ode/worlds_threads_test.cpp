#include <gtest/gtest.h>

#include <thread>

#include "modules/dynamics_ode/engine.h"

// ODE's own default is one list of solver jobs for all worlds of the process, without a lock.
namespace presa::ode {
namespace {

constexpr double kStep = 1e-3;

/// Where a thrown rod stands after many short solves of both methods.
Vec3 whereRodEnds(int seed) {
  Engine engine({0, 0, -9.81}, static_cast<std::uint64_t>(seed), 16);
  const dBodyID rod = dBodyCreate(engine.world());
  dMass mass;
  dMassSetBoxTotal(&mass, 0.1, 0.2, 0.02, 0.01);
  dBodySetMass(rod, &mass);
  dBodySetLinearVel(rod, 0.1 * seed, 0, 2);
  dBodySetAngularVel(rod, 1, 2, 3 + seed);
  for (int step = 0; step < 5000; ++step) {
    if (!engine.solveDirectly(kStep)) ADD_FAILURE() << "direct solver, step " << step;
    engine.solveIteratively(kStep, 10);
  }
  const dReal* p = dBodyGetPosition(rod);
  return {p[0], p[1], p[2]};
}

TEST(WorldsOnSeveralThreads, StepAsOnOne) {
  constexpr std::size_t kThreads = 4;
  std::vector<Vec3> together(kThreads);
  std::vector<std::thread> threads;
  threads.reserve(kThreads);
  for (std::size_t i = 0; i < kThreads; ++i)
    threads.emplace_back([&, i] {
      together[i] = whereRodEnds(static_cast<int>(i));
      detachThread();
    });
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < kThreads; ++i) EXPECT_EQ(together[i], whereRodEnds(static_cast<int>(i))) << i;
}

}  // namespace
}  // namespace presa::ode
