#include <dlfcn.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "framework/core/schedule/executor.h"
#include "framework/session/run.h"
#include "modules/haptics_proxy/haptics_proxy.h"

/// effects_probe SCENE TICKS STAGE SHAPE [PATH=VALUE…]: runs the scene in lockstep with the haptic stages that it
/// needs, except STAGE ("none", "friction", "damping", "shading"; "gravity": gravity is never set in ODE's world), and
/// prints the hash of all states and the sum of all forces. SHAPE: "as_is", or "mesh" or "smooth" to make the first
/// body a ball of 1280 triangles, without the mesh reader, whose time limits do not hold under a profiler.
namespace {
bool without_gravity = false;
}

// Interposes the engine's function: the dynamic linker finds the program's first.
extern "C" void dWorldSetGravity(void* world, double x, double y, double z) {
  if (without_gravity) return;
  void* ode = dlopen("libode.so.8", RTLD_LAZY | RTLD_NOLOAD);
  using Set = void (*)(void*, double, double, double);
  reinterpret_cast<Set>(dlsym(ode, "dWorldSetGravity"))(world, x, y, z);
  dlclose(ode);
}

namespace presa {
namespace {

struct ForceSum final : Module {
  ForceSum() : Module("force_sum", RateGroup::kHaptic) {}
  void step(const Tick&) noexcept override {
    for (std::size_t f = 0; f < contact->fingers.size(); ++f) sum += contact->fingers[f].f_H_W;
  }
  In<ContactExchange> contact{*this, "contact_exchange"};
  Vec3 sum = Vec3::Zero();
};

void makeBall(Loaded& loaded, bool smooth) {
  World world = *loaded.world;
  world.meshes[0].haptic = std::make_shared<const TriMesh>(makeSphere(0.05, 3));
  world.scene.bodies[0].haptic->shape = MeshRef{};
  world.scene.bodies[0].haptic->smooth = smooth;
  indexHapticMeshes(world);
  loaded.world = std::make_shared<const World>(std::move(world));
  loaded.plan.modules.push_back({"collision_fcl", RateGroup::kCollision, "the ball is a mesh"});
}

int probe(int count, char** arguments) {
  Inputs inputs{arguments[1], "", {arguments + 5, arguments + count}};
  Diagnostics diagnostics;
  Loaded loaded = loadWorld(inputs, {}, diagnostics);
  if (diagnostics.hasErrors()) {
    std::fputs(diagnostics.text().c_str(), stderr);
    return 2;
  }
  const std::string shape = arguments[4];
  if (shape != "as_is") makeBall(loaded, shape == "smooth");
  HapticEffects effects = effectsOf(*loaded.world, loaded.options);
  const std::string without = arguments[3];
  effects.friction = effects.friction && without != "friction";
  effects.damping = effects.damping && without != "damping";
  effects.surface_effects = effects.surface_effects && without != "shading";
  without_gravity = without == "gravity";

  std::erase_if(loaded.plan.modules, [](const PlannedModule& m) { return m.plugin == "haptics_proxy"; });
  Session::Options options;
  options.more.push_back(std::make_unique<HapticsProxy>(loaded.world, effects));
  auto sum = std::make_unique<ForceSum>();
  const ForceSum& forces = *sum;
  options.more.push_back(std::move(sum));
  RunControl control;
  loaded.options.duration = std::atof(arguments[2]) / loaded.world->scene.rates.haptic;
  Run run(std::move(loaded), control, std::move(options));
  run.execute();
  std::printf("hash %016llx forces %a %a %a\n", static_cast<unsigned long long>(run.monitor().hash()), forces.sum.x(),
              forces.sum.y(), forces.sum.z());
  return 0;
}

}  // namespace
}  // namespace presa

int main(int count, char** arguments) {
  if (count < 5) return 2;
  return presa::probe(count, arguments);
}
