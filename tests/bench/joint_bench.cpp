#include <benchmark/benchmark.h>
#include <ode/ode.h>

#include <memory>
#include <vector>

#include "modules/dynamics_ode/ode_world.h"

// Cost of a dynamics step with fifty hinges compared with bare ODE and its hinges: fifty doors, or a chain of fifty links
// that swings from its end.
namespace presa::ode {
namespace {

constexpr int kHinges = 50;
constexpr double kHingeStep = 0.005, kSide = 0.02, kLength = 0.1, kLinkMass = 0.05;

bool isChain(const benchmark::State& state) { return state.range(0) == 1; }
Pose linkAt(int i, bool chain) {
  return {chain ? Vec3((i + 0.5) * kLength, 0, 0) : Vec3(kLength / 2, i * 0.2, 0), Quat::Identity()};
}
Vec3 anchorOf(int i, bool chain) { return linkAt(i, chain).p - Vec3(kLength / 2, 0, 0); }
BodyInertia inertiaOfLink() {
  const double along = kSide * kSide / 6, across = (kSide * kSide + kLength * kLength) / 12;
  return {kLinkMass, Vec3::Zero(), kLinkMass * Vec3(along, across, across).asDiagonal().toDenseMatrix()};
}

std::shared_ptr<const World> hingedWorld(bool chain) {
  auto world = std::make_shared<World>();
  world->scene.materials.emplace_back();
  for (int i = 0; i < kHinges; ++i) {
    Body body;
    body.X_WB = linkAt(i, chain);
    body.physics = Geometry{Box{{kLength, kSide, kSide}}, {}, {}};
    world->scene.bodies.push_back(body);
    world->meshes.emplace_back();
    world->inertias.push_back(inertiaOfLink());
    Joint joint;
    joint.body = static_cast<std::size_t>(i);
    if (chain && i > 0) joint.to = joint.body - 1;
    joint.p_BJ = {-kLength / 2, 0, 0};
    joint.axes.emplace_back().dhat_B = Vec3::UnitY();
    world->scene.joints.push_back(joint);
  }
  return world;
}

void BM_Hinges(benchmark::State& state) {
  OdeOptions options;
  options.method.sleeping = false;
  OdeWorld world(hingedWorld(isChain(state)), options);
  world.makeRoom(ContactExchange());
  double time = 0;
  for (auto _ : state) {
    world.step({}, time, kHingeStep);
    time += kHingeStep;
  }
}
BENCHMARK(BM_Hinges)->ArgName("chain")->Arg(0)->Arg(1)->Iterations(2000);

/// Argument 1: 0 the direct solver, else iterations of the iterative one. It collides as Presa does: not.
void BM_HingesBareOde(benchmark::State& state) {
  dInitODE2(0);
  dAllocateODEDataForThread(dAllocateMaskAll);
  const dWorldID world = dWorldCreate();
  dWorldSetGravity(world, 0, 0, -9.81);
  std::vector<dBodyID> links;
  for (int i = 0; i < kHinges; ++i) {
    const bool chain = isChain(state);
    const Vec3 p = linkAt(i, chain).p, anchor = anchorOf(i, chain);
    const Mat3 I = inertiaOfLink().inertia;
    dMass mass;
    dMassSetParameters(&mass, kLinkMass, 0, 0, 0, I(0, 0), I(1, 1), I(2, 2), 0, 0, 0);
    links.push_back(dBodyCreate(world));
    dBodySetMass(links.back(), &mass);
    dBodySetPosition(links.back(), p.x(), p.y(), p.z());
    const dJointID hinge = dJointCreateHinge(world, nullptr);
    dJointAttach(hinge, links.back(), chain && i > 0 ? links[links.size() - 2] : nullptr);
    dJointSetHingeAnchor(hinge, anchor.x(), anchor.y(), anchor.z());
    dJointSetHingeAxis(hinge, 0, 1, 0);
  }
  const int iterations = static_cast<int>(state.range(1));
  if (iterations > 0) dWorldSetQuickStepNumIterations(world, iterations);
  for (auto _ : state) {
    iterations > 0 ? dWorldQuickStep(world, kHingeStep) : dWorldStep(world, kHingeStep);
  }
  dWorldDestroy(world);
}
BENCHMARK(BM_HingesBareOde)->ArgNames({"chain", "iterations"})->ArgsProduct({{0, 1}, {0, 20}})->Iterations(2000);

}  // namespace
}  // namespace presa::ode
