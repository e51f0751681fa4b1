#include <benchmark/benchmark.h>
#include <ode/ode.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "framework/core/schedule/clock.h"
#include "modules/dynamics_ode/ode_world.h"

// Cost of a dynamics step compared with bare ODE: the same settled cubes, collided and solved by hand with ODE's own
// friction, the same solver and number of iterations.
namespace presa::ode {
namespace {

constexpr double kStep = 0.005;
constexpr double kEdge = 0.05;
constexpr double kMass = 0.1;
constexpr int kIterations = 50;
constexpr double kSettle = 3;  // [s]

// n^3 cubes: apart on the table (n^3 islands), as touching blocks of n layers (one island), or poured in any
// orientation into a bin (one island)
enum Layout { kApart, kBlock, kHeap };

Pose placeOf(int i, int n, Layout layout) {
  const Vec3 cell(i % n, i / n % n, i / (n * n));
  switch (layout) {
    case kApart:
      return {Vec3(0.1 * (cell.x() + n * cell.z()), 0.1 * cell.y(), kEdge / 2), Quat::Identity()};
    case kBlock:
      return {Vec3(kEdge * cell + Vec3(0, 0, kEdge / 2)), Quat::Identity()};
    default:
      return {Vec3(1.3 * kEdge * (cell + Vec3(-0.5 * n + 0.5, -0.5 * n + 0.5, 1))),
              Quat(Eigen::AngleAxisd(0.7 * i, Vec3(1, i % 3, i % 5).normalized()))};
  }
}

std::shared_ptr<const World> sceneOf(int n, Layout layout) {
  auto world = std::make_shared<World>();
  Material material;
  material.friction_static = material.friction_dynamic = 0.5;
  world->scene.materials.push_back(material);
  world->scene.dynamics.iterations = kIterations;
  const auto add = [&](const Vec3& size, const Pose& X_WB, double mass) {
    Body body;
    body.fixed = mass == 0;
    body.X_WB = X_WB;
    body.physics = Geometry{Box{size}, {}, {}};
    world->scene.bodies.push_back(body);
    world->meshes.emplace_back();
    world->inertias.push_back({mass, Vec3::Zero(), mass * size.x() * size.x() / 6 * Mat3::Identity()});
  };
  add({10, 10, 0.1}, {{0, 0, -0.05}, Quat::Identity()}, 0);
  for (int side = 0; side < 4 && layout == kHeap; ++side) {
    const double middle = (0.7 * n + 0.5) * kEdge, out = side % 2 == 0 ? middle : -middle;
    add(side < 2 ? Vec3(kEdge, 10, 10) : Vec3(10, kEdge, 10),
        {side < 2 ? Vec3(out, 0, 0) : Vec3(0, out, 0), Quat::Identity()}, 0);
  }
  for (int i = 0; i < n * n * n; ++i) add(Vec3::Constant(kEdge), placeOf(i, n, layout), kMass);
  return world;
}

OdeOptions optionsOf(const World& world, bool direct) {
  OdeOptions options;
  options.method = world.scene.dynamics;
  options.method.solver = direct ? DynamicsSettings::Solver::kDirect : DynamicsSettings::Solver::kIterative;
  options.method.substeps = 1;  // as bare ODE
  options.method.sleeping = false;
  return options;
}

class BareOde {
 public:
  BareOde(const World& world, const ObjectState& state)
      : world_(dWorldCreate()), space_(dHashSpaceCreate(nullptr)), joints_(dJointGroupCreate(0)) {
    dHashSpaceSetLevels(space_, -10, 6);
    dWorldSetGravity(world_, 0, 0, -9.81);
    dWorldSetCFM(world_, 1e-10);
    dWorldSetQuickStepNumIterations(world_, kIterations);
    for (std::size_t i = 0; i < world.scene.bodies.size(); ++i) {
      const Vec3& size = std::get<Box>(world.scene.bodies[i].physics->shape).size;
      const Pose& X_WB = state.bodies[i].X_WB_end;
      const dQuaternion q{X_WB.q.w(), X_WB.q.x(), X_WB.q.y(), X_WB.q.z()};
      const dGeomID geom = dCreateBox(space_, size.x(), size.y(), size.z());
      if (!world.scene.bodies[i].fixed) {
        const dBodyID body = dBodyCreate(world_);
        dMass mass;
        dMassSetBoxTotal(&mass, kMass, kEdge, kEdge, kEdge);
        dBodySetMass(body, &mass);
        dGeomSetBody(geom, body);
      }
      dGeomSetPosition(geom, X_WB.p.x(), X_WB.p.y(), X_WB.p.z());
      dGeomSetQuaternion(geom, q);
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
    contacts_ = 0;
    dSpaceCollide(space_, this, [](void* self, dGeomID a, dGeomID b) { static_cast<BareOde*>(self)->touch(a, b); });
    if (quick) {
      dWorldQuickStep(world_, kStep);
    } else {
      dWorldStep(world_, kStep);
    }
    dJointGroupEmpty(joints_);
  }
  int contacts() const { return contacts_; }

 private:
  void touch(dGeomID a, dGeomID b) {
    if (dGeomGetBody(a) == nullptr && dGeomGetBody(b) == nullptr) return;
    std::array<dContactGeom, 8> found;
    const int count = dCollide(a, b, static_cast<int>(found.size()), found.data(), sizeof(dContactGeom));
    contacts_ += count;
    for (int i = 0; i < count; ++i) {
      dContact contact{};
      contact.surface.mode = dContactApprox1 | dContactSoftERP | dContactSoftCFM;
      contact.surface.mu = 0.5;
      contact.surface.soft_erp = 0.2;
      contact.surface.soft_cfm = 1e-4;  // as in Presa for these masses
      contact.geom = found[static_cast<std::size_t>(i)];
      dJointAttach(dJointCreateContact(world_, joints_, &contact), dGeomGetBody(a), dGeomGetBody(b));
    }
  }
  dWorldID world_;
  dSpaceID space_;
  dJointGroupID joints_;
  int contacts_ = 0;
};

// Presa and bare ODE alternate, so that a noisy machine slows both.
void BM_DynamicsStep(benchmark::State& state) {
  const auto n = static_cast<int>(state.range(0));
  const auto layout = static_cast<Layout>(state.range(1));
  const auto world = sceneOf(n, layout);
  OdeWorld bodies(world, optionsOf(*world, layout == kApart));
  ObjectState out;
  double time = 0;
  const auto step = [&] {
    bodies.step({}, time, kStep, out);
    time += kStep;
  };
  while (time < kSettle) step();
  BareOde bare(*world, out);
  std::vector<std::int64_t> ours, theirs;
  for (auto _ : state) {
    const std::int64_t begin = threadCpuNs();
    step();
    const std::int64_t middle = threadCpuNs();
    bare.step(layout != kApart);
    ours.push_back(middle - begin);
    theirs.push_back(threadCpuNs() - middle);
  }
  const auto median = [](std::vector<std::int64_t>& all) {
    std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2), all.end());
    return static_cast<double>(all[all.size() / 2]) * 1e-3;
  };
  state.counters["presa_us"] = median(ours);
  state.counters["bare_us"] = median(theirs);
  state.counters["ratio"] = median(ours) / median(theirs);
  state.counters["contacts"] = static_cast<double>(bodies.contacts().size());
  state.counters["bare_contacts"] = bare.contacts();
  state.counters["fallbacks"] = static_cast<double>(bodies.fallbackSteps());
}

// A pile of 27 cubes that has rested for five seconds, awake and asleep.
void BM_SleepingPile(benchmark::State& state) {
  const auto world = sceneOf(3, kBlock);
  OdeOptions options = optionsOf(*world, false);
  options.method.iterations = 0;
  options.method.substeps = 0;
  const auto median = [&](bool sleeping, std::int64_t& asleep) {
    options.method.sleeping = sleeping;
    OdeWorld bodies(world, options);
    ObjectState out;
    std::vector<std::int64_t> times;
    double time = 0;
    for (int n = 0; n < 1500; ++n, time += kStep) {
      const std::int64_t begin = threadCpuNs();
      bodies.step({}, time, kStep, out);
      if (n >= 1000) times.push_back(threadCpuNs() - begin);
    }
    asleep = 0;
    for (const BodyMotion& body : out.bodies) asleep += body.asleep ? 1 : 0;
    std::nth_element(times.begin(), times.begin() + 250, times.end());
    return static_cast<double>(times[250]) * 1e-3;
  };
  for (auto _ : state) {
    std::int64_t none = 0, asleep = 0;
    const double awake_us = median(false, none), asleep_us = median(true, asleep);
    state.counters["awake_us"] = awake_us;
    state.counters["asleep_us"] = asleep_us;
    state.counters["ratio"] = asleep_us / awake_us;
    state.counters["bodies_asleep"] = static_cast<double>(asleep);
  }
}
BENCHMARK(BM_SleepingPile)->Iterations(1)->Unit(benchmark::kMillisecond);

BENCHMARK(BM_DynamicsStep)
    ->ArgNames({"n", "layout"})
    ->ArgsProduct({{3, 5}, {kApart, kBlock, kHeap}})
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace presa::ode
