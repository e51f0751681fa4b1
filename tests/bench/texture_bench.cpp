#include <benchmark/benchmark.h>

#include <cmath>
#include <string>

#include "framework/haptics/renderers.h"
#include "framework/haptics/surface_effects.h"
#include "tests/support/finger_world.h"

// Cost of a surface effect in a haptic tick in which a finger touches a box, or a mesh: the floor is 0.5 us.
namespace presa {
namespace {

constexpr const char* kBox = R"(<haptic><box size="0.1 0.1 0.1"/></haptic>)";

/// The top of the geometry lies at z = 0.05.
void effect(benchmark::State& state, const std::string& element, const std::string& haptic = kBox) {
  const auto world = test::fingerWorld(R"(<scene version="1.0" name="block"><world gravity="0 0 0"/>
    <materials><material name="any" stiffness="1000"><friction static="0.5"/><)" +
                                       element +
                                       R"(/></material></materials>
    <body name="block" fixed="true">)" +
                                       haptic + R"(</body>
    <devices><device role="finger"/></devices></scene>)");
  constexpr double kRadius = 0.008;
  const auto renderer = makeRenderer(*world);
  const Touchables touchables(*world);
  Surroundings near(touchables.meshCount());
  SurfaceEffects effects(*world);
  BoundedList<RenderedContact> own;
  const Pose X_WA;
  const Vec3 free(0, 0, 0.06), g(0, 0, 0.057);
  touchables.surround(near, kNoBody, g, 2 * kRadius, 0.01, 1e-3, nullptr);
  near.setStep(0.01);
  const ProxyState start{free, free, false, false};
  const ProxyContact touched = renderer->touch({0, g, kRadius, start, X_WA, near, own});
  if (!touched.state.touching) return state.SkipWithError("no contact");
  double phase = 0;
  const bool friction = effects.changeFriction();
  for (auto _ : state) {
    phase += 0.01;
    ProxyContact contact = touched;
    contact.state.god_object.x() = 0.02 * std::sin(phase);
    contact.tangential_displacement.x() = 1e-3 * std::sin(phase);
    double softness = 1;
    const SurfaceInput input{0, 0, 1e-3, kRadius, g, contact, X_WA, touchables, near, nullptr};
    if (friction) benchmark::DoNotOptimize(effects.friction(input));
    effects.act(input, 1000, contact, softness);
    benchmark::DoNotOptimize(contact);
  }
}

void texture(benchmark::State& state, const std::string& shape) {
  effect(state, "texture amplitude=\"0.0001\" wavelength=\"0.002\" shape=\"" + shape + "\"");
}
BENCHMARK_CAPTURE(texture, sine, "sine");
BENCHMARK_CAPTURE(texture, grid, "grid");
BENCHMARK_CAPTURE(texture, noise, "noise");

void textureImage(benchmark::State& state) {
  effect(state,
         "texture_image file=\"" PRESA_SOURCE_DIR "/config/textures/weave.png\" width=\"0.006\" amplitude=\"0.0001\"");
}
BENCHMARK(textureImage)->Name("texture/image");

void materialImage(benchmark::State& state) {
  effect(state, "material_image file=\"" PRESA_SOURCE_DIR
                "/config/textures/pads.png\" width=\"0.04\" stiffness=\"0.4\" friction=\"0.2\"");
}
BENCHMARK(materialImage)->Name("texture/material");

/// In a triangle at the border of the inlaid pad.
void meshMaterial(benchmark::State& state) {
  effect(state, R"(material_part name="gel" stiffness="0.4" friction="0.2")",
         "<haptic pos=\"-0.0135 0.0007 0.03\"><mesh file=\"" PRESA_SOURCE_DIR "/config/meshes/inlay.obj\"/></haptic>");
}
BENCHMARK(meshMaterial)->Name("texture/mesh_material");

void perturbation(benchmark::State& state, const std::string& form) {
  effect(state, "perturbation shape=\"sine\" amplitude=\"0.0001\" wavelength=\"0.002\" form=\"" + form + "\"");
}
BENCHMARK_CAPTURE(perturbation, conservative, "conservative");
BENCHMARK_CAPTURE(perturbation, printed, "printed");

void layers(benchmark::State& state) { effect(state, "layers skin=\"0.2\" thickness=\"0.001\""); }
BENCHMARK(layers);

}  // namespace
}  // namespace presa
