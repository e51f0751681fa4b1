#include <benchmark/benchmark.h>
#include <ode/ode.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "modules/dynamics_ode/ode_world.h"

// What a dynamics step costs over ODE alone: the same cubes, collided and solved by hand with ODE's plain friction.
namespace presa::ode {
namespace {

constexpr double kStep = 0.005;
constexpr double kEdge = 0.05;
constexpr double kMass = 0.1;

// n^3 cubes: apart on the table (n^3 islands) or as touching blocks of n layers (one island)
std::vector<Vec3> places(int n, bool apart) {
  std::vector<Vec3> all;
  for (int i = 0; i < n * n * n; ++i) {
    const Vec3 cell(i % n, i / n % n, i / (n * n));
    all.push_back(apart ? Vec3(0.1 * (cell.x() + n * cell.z()), 0.1 * cell.y(), kEdge / 2)
                        : Vec3(kEdge * cell + Vec3(0, 0, kEdge / 2)));
  }
  return all;
}

std::shared_ptr<const World> sceneOf(const std::vector<Vec3>& cubes) {
  auto world = std::make_shared<World>();
  Material material;
  material.friction_static = material.friction_dynamic = 0.5;
  world->scene.materials.push_back(material);
  const auto add = [&](const Vec3& size, const Vec3& p, double mass) {
    Body body;
    body.fixed = mass == 0;
    body.X_WB.p = p;
    body.physics = Geometry{Box{size}, {}, {}};
    world->scene.bodies.push_back(body);
    world->meshes.emplace_back();
    world->inertias.push_back({mass, Vec3::Zero(), mass * size.x() * size.x() / 6 * Mat3::Identity()});
  };
  add({10, 10, 0.1}, {0, 0, -0.05}, 0);
  for (const Vec3& p : cubes) add(Vec3::Constant(kEdge), p, kMass);
  return world;
}

class BareOde {
 public:
  explicit BareOde(const std::vector<Vec3>& cubes)
      : world_(dWorldCreate()), space_(dHashSpaceCreate(nullptr)), joints_(dJointGroupCreate(0)) {
    dHashSpaceSetLevels(space_, -10, 6);
    dWorldSetGravity(world_, 0, 0, -9.81);
    dWorldSetCFM(world_, 1e-10);
    dWorldSetQuickStepNumIterations(world_, 50);
    dGeomSetPosition(dCreateBox(space_, 10, 10, 0.1), 0, 0, -0.05);
    for (const Vec3& p : cubes) {
      const dBodyID body = dBodyCreate(world_);
      dMass mass;
      dMassSetBoxTotal(&mass, kMass, kEdge, kEdge, kEdge);
      dBodySetMass(body, &mass);
      dBodySetPosition(body, p.x(), p.y(), p.z());
      dGeomSetBody(dCreateBox(space_, kEdge, kEdge, kEdge), body);
    }
  }
  ~BareOde() {
    dJointGroupDestroy(joints_);
    dSpaceDestroy(space_);
    dWorldDestroy(world_);
  }
  BareOde(const BareOde&) = delete;
  BareOde& operator=(const BareOde&) = delete;

  void step(bool quick) {
    dSpaceCollide(space_, this, [](void* self, dGeomID a, dGeomID b) { static_cast<BareOde*>(self)->touch(a, b); });
    if (quick) {
      dWorldQuickStep(world_, kStep);
    } else {
      dWorldStep(world_, kStep);
    }
    dJointGroupEmpty(joints_);
  }

 private:
  void touch(dGeomID a, dGeomID b) {
    std::array<dContactGeom, 8> found;
    const int count = dCollide(a, b, static_cast<int>(found.size()), found.data(), sizeof(dContactGeom));
    for (int i = 0; i < count; ++i) {
      dContact contact{};
      contact.surface.mode = dContactApprox1 | dContactSoftERP | dContactSoftCFM;
      contact.surface.mu = 0.5;
      contact.surface.soft_erp = 0.2;
      contact.surface.soft_cfm = 1e-6;
      contact.geom = found[static_cast<std::size_t>(i)];
      dJointAttach(dJointCreateContact(world_, joints_, &contact), dGeomGetBody(a), dGeomGetBody(b));
    }
  }
  dWorldID world_;
  dSpaceID space_;
  dJointGroupID joints_;
};

void BM_DynamicsStep(benchmark::State& state) {
  OdeWorld bodies(sceneOf(places(static_cast<int>(state.range(0)), state.range(1) != 0)));
  ObjectState out;
  double time = 0;
  const auto step = [&] {
    bodies.step({}, time, kStep, out);
    time += kStep;
  };
  for (int i = 0; i < 100; ++i) step();
  for (auto _ : state) step();
  state.counters["contacts"] = static_cast<double>(bodies.contacts().size());
  state.counters["fallbacks"] = static_cast<double>(bodies.fallbackSteps());
}

void BM_BareOdeStep(benchmark::State& state) {
  const bool apart = state.range(1) != 0;
  const OdeWorld ode_is_started(sceneOf({}));
  BareOde bodies(places(static_cast<int>(state.range(0)), apart));
  for (int i = 0; i < 100; ++i) bodies.step(!apart);
  for (auto _ : state) bodies.step(!apart);
}

BENCHMARK(BM_DynamicsStep)->ArgNames({"n", "apart"})->ArgsProduct({{3, 5}, {1, 0}})->Unit(benchmark::kMicrosecond);
BENCHMARK(BM_BareOdeStep)->ArgNames({"n", "apart"})->ArgsProduct({{3, 5}, {1, 0}})->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace presa::ode
