#include <benchmark/benchmark.h>
#include <ode/ode.h>

#include <memory>
#include <vector>

#include "modules/dynamics_ode/ode_world.h"

// Cost of a dynamics step with fifty joints compared with bare ODE and its joints, CPU time: fifty doors, a chain of fifty
// links that swings from its end, fifty pairs of links that fall and turn, fifty drawers that slide.
namespace presa::ode {
namespace {

enum Scene { kDoors, kChain, kPairs, kDrawers };
constexpr int kJoints = 50, kSteps = 2000;
constexpr double kJointStep = 0.005, kSide = 0.02, kLength = 0.1, kLinkMass = 0.05;

Scene sceneOf(const benchmark::State& state) { return static_cast<Scene>(state.range(0)); }
int linksOf(Scene scene) { return scene == kPairs ? 2 * kJoints : kJoints; }
/// The link that link i hangs from by a joint at its end; -1 the world, -2 none: it is free.
int heldBy(int i, Scene scene) {
  if (scene == kChain) return i - 1;
  if (scene == kPairs) return i % 2 == 0 ? -2 : i - 1;
  return -1;
}
Pose linkAt(int i, Scene scene) {
  if (scene == kChain) return {Vec3((i + 0.5) * kLength, 0, 0), Quat::Identity()};
  if (scene == kPairs) return {Vec3((i % 2 + 0.5) * kLength, i / 2 * 0.3, 0), Quat::Identity()};
  return {Vec3(kLength / 2, i * 0.2, 0), Quat::Identity()};
}
Vec3 anchorOf(int i, Scene scene) { return linkAt(i, scene).p - Vec3(kLength / 2, 0, 0); }
Vec3 axisOf(Scene scene) { return scene == kDrawers ? Vec3::UnitX() : Vec3::UnitY(); }
Vec3 velocityOf(Scene scene) { return scene == kDrawers ? Vec3(0.1, 0, 0) : Vec3(0, 0, 0); }
Vec3 spinOf(int i, Scene scene) { return scene == kPairs ? Vec3(0.3, i % 2 == 0 ? -2 : 1, 0.5) : Vec3(Vec3::Zero()); }
Vec3 gravityOf(Scene scene) { return scene == kPairs ? Vec3(0, 0, -0.1) : Vec3(0, 0, -9.81); }
BodyInertia inertiaOfLink() {
  const double along = kSide * kSide / 6, across = (kSide * kSide + kLength * kLength) / 12;
  return {kLinkMass, Vec3::Zero(), kLinkMass * Vec3(along, across, across).asDiagonal().toDenseMatrix()};
}

std::shared_ptr<const World> jointedWorld(Scene scene) {
  auto world = std::make_shared<World>();
  world->scene.gravity = gravityOf(scene);
  world->scene.materials.emplace_back();
  for (int i = 0; i < linksOf(scene); ++i) {
    Body body;
    body.X_WB = linkAt(i, scene);
    body.v_WCm = velocityOf(scene);
    body.w_WB = spinOf(i, scene);
    body.physics = Geometry{Box{{kLength, kSide, kSide}}, {}, {}};
    world->scene.bodies.push_back(body);
    world->meshes.emplace_back();
    world->inertias.push_back(inertiaOfLink());
    if (heldBy(i, scene) == -2) continue;
    Joint joint;
    joint.type = scene == kDrawers ? JointType::kSlider : JointType::kHinge;
    joint.body = static_cast<std::size_t>(i);
    if (heldBy(i, scene) >= 0) joint.to = static_cast<std::size_t>(heldBy(i, scene));
    joint.p_BJ = {-kLength / 2, 0, 0};
    JointAxis& axis = joint.axes.emplace_back();
    axis.dhat_B = axisOf(scene);
    axis.turns = scene != kDrawers;
    world->scene.joints.push_back(joint);
  }
  return world;
}

void BM_Hinges(benchmark::State& state) {
  OdeOptions options;
  options.method.sleeping = false;
  OdeWorld world(jointedWorld(sceneOf(state)), options);
  world.makeRoom(ContactExchange());
  double time = 0;
  for (auto _ : state) {
    world.step({}, time, kJointStep);
    time += kJointStep;
  }
}
BENCHMARK(BM_Hinges)->ArgName("scene")->DenseRange(kDoors, kDrawers)->Iterations(kSteps);

void collideUnlessJoined(void* /*data*/, dGeomID a, dGeomID b) {
  if (dAreConnected(dGeomGetBody(a), dGeomGetBody(b)) != 0) return;
  dContactGeom contacts[4];
  benchmark::DoNotOptimize(dCollide(a, b, 4, contacts, sizeof contacts[0]));
}

/// Argument 1: 0 the direct solver, else iterations of the iterative one; 2: whether it looks for contacts, as Presa does
/// in each step (there are none), in a space of ODE's.
void BM_HingesBareOde(benchmark::State& state) {
  const Scene scene = sceneOf(state);
  dInitODE2(0);
  dAllocateODEDataForThread(dAllocateMaskAll);
  const dWorldID world = dWorldCreate();
  const Vec3 g = gravityOf(scene), axis = axisOf(scene);
  dWorldSetGravity(world, g.x(), g.y(), g.z());
  const bool collides = state.range(2) != 0;
  const dSpaceID space = dHashSpaceCreate(nullptr);
  std::vector<dBodyID> links;
  for (int i = 0; i < linksOf(scene); ++i) {
    const Vec3 p = linkAt(i, scene).p, anchor = anchorOf(i, scene), v = velocityOf(scene), w = spinOf(i, scene);
    const Mat3 I = inertiaOfLink().inertia;
    dMass mass;
    dMassSetParameters(&mass, kLinkMass, 0, 0, 0, I(0, 0), I(1, 1), I(2, 2), 0, 0, 0);
    links.push_back(dBodyCreate(world));
    dBodySetMass(links.back(), &mass);
    dBodySetPosition(links.back(), p.x(), p.y(), p.z());
    dBodySetLinearVel(links.back(), v.x(), v.y(), v.z());
    dBodySetAngularVel(links.back(), w.x(), w.y(), w.z());
    if (collides) dGeomSetBody(dCreateBox(space, kLength, kSide, kSide), links.back());
    const int held_by = heldBy(i, scene);
    if (held_by == -2) continue;
    const dBodyID to = held_by < 0 ? nullptr : links[static_cast<std::size_t>(held_by)];
    if (scene == kDrawers) {
      const dJointID slider = dJointCreateSlider(world, nullptr);
      dJointAttach(slider, links.back(), to);
      dJointSetSliderAxis(slider, axis.x(), axis.y(), axis.z());
    } else {
      const dJointID hinge = dJointCreateHinge(world, nullptr);
      dJointAttach(hinge, links.back(), to);
      dJointSetHingeAnchor(hinge, anchor.x(), anchor.y(), anchor.z());
      dJointSetHingeAxis(hinge, axis.x(), axis.y(), axis.z());
    }
  }
  const int iterations = static_cast<int>(state.range(1));
  if (iterations > 0) dWorldSetQuickStepNumIterations(world, iterations);
  for (auto _ : state) {
    if (collides) dSpaceCollide(space, nullptr, collideUnlessJoined);
    iterations > 0 ? dWorldQuickStep(world, kJointStep) : dWorldStep(world, kJointStep);
  }
  dSpaceDestroy(space);
  dWorldDestroy(world);
}
BENCHMARK(BM_HingesBareOde)
    ->ArgNames({"scene", "iterations", "collides"})
    ->ArgsProduct({benchmark::CreateDenseRange(kDoors, kDrawers, 1), {0, 20}, {0, 1}})
    ->Iterations(kSteps);

}  // namespace
}  // namespace presa::ode
