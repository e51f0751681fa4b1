#include <cmath>
#include <numbers>

#include "experiments/stability/cases.h"
#include "experiments/stability/methods.h"
#include "experiments/study/prescribed_finger.h"

namespace presa::stability::texture_loops {
namespace {

constexpr double kRadius = 0.008, kLoop = 0.004;     // of the fingertip; of its path [m]
constexpr double kPeriod = 4, kRest = 1, kLaps = 5;  // of a lap; before the first one [s]; laps
constexpr double kDeep = 0.0015, kHigh = -0.0005;    // deepest and highest point of the path below the face [m]

/// Round in 4 s; `touch_and_go` leaves the face and comes back elsewhere in each lap.
PrescribedFinger::State circle(double time, bool touch_and_go) {
  const double omega = 2 * std::numbers::pi / kPeriod, angle = omega * std::max(0.0, time - kRest);
  const double middle = touch_and_go ? (kDeep + kHigh) / 2 : kDeep, swing = touch_and_go ? (kDeep - kHigh) / 2 : 0;
  const double depth = middle + swing * std::sin(angle + 0.7);
  PrescribedFinger::State state;
  state.p_WH = {kLoop * std::cos(angle), kLoop * std::sin(angle), kRadius - depth};
  if (time < kRest) return state;
  state.v_WH = {-kLoop * omega * std::sin(angle), kLoop * omega * std::cos(angle),
                -swing * omega * std::cos(angle + 0.7)};
  return state;
}

constexpr const char* kNone = "none";

/// What the block feels like, as overrides of its material.
struct Surface {
  std::string name, wavelength;
  std::vector<std::string> sets;
  Method method = ours();
  std::string scene = "texture_loops.xml";
};

Surface texture(const std::string& shape, const std::string& amplitude, const std::string& wavelength) {
  const std::string element = "material/stone/texture/";
  return {shape,
          number(1000 * std::stod(wavelength)) + " mm",
          {element + "shape=" + shape, element + "amplitude=" + amplitude, element + "wavelength=" + wavelength}};
}

/// The shipped weave.
Surface image() {
  const std::string element = "material/stone/texture_image/";
  return {"image",
          "6 mm",
          {element + "file=../../../config/textures/weave.png", element + "width=0.006", element + "amplitude=0.0001"}};
}

/// The shipped pads, soft where the image is black, drawn out so that the path crosses their borders.
Surface materialImage() {
  Surface surface{"material by image", "12 mm", {}};
  for (const char* value : {"file=../../../config/textures/pads.png", "width=0.012", "height=0.02", "stiffness=0.7"})
    surface.sets.push_back(std::string("material/stone/material_image/") + value);
  return surface;
}

/// A pad of half the stiffness, by the materials of the mesh's triangles, whose cells are 5 mm wide.
Surface meshMaterial() { return {"material by mesh", "5 mm", {}, ours(), "texture_loops_mesh.xml"}; }

/// Force perturbation of a sine.
Surface perturbation(const Method& form) {
  Surface surface{"perturbation", "2 mm", {}, form};
  for (const char* value : {"shape=sine", "amplitude=0.0002", "wavelength=0.002"})
    surface.sets.push_back(std::string("material/stone/perturbation/") + value);
  return surface;
}

/// With a soft skin below it.
Surface overLayers(Surface surface) {
  const std::string element = "material/stone/layers/";
  for (const char* value : {"skin=0.2", "thickness=0.0005", "transition=0.0005"})
    surface.sets.push_back(element + value);
  surface.name += surface.name.empty() ? "layers" : " over layers";
  return surface;
}

std::vector<Finding> stroke(const Surface& surface, bool touch_and_go, const std::string& rate) {
  std::vector<std::string> sets = surface.sets + surface.method;
  sets.push_back("rates/haptic=" + rate);
  DeviceList devices;
  devices.push_back(std::make_unique<PrescribedFinger>([=](double time) { return circle(time, touch_and_go); }));
  StudyRun run(specOf(surface.scene, std::move(sets), kRest + kLaps * kPeriod), std::move(devices));
  double net = 0, moved = 0;
  Vec3 last_p = Vec3::Zero(), last_f = Vec3::Zero();
  Curve gained{"energy that the finger has gained", {}, {}};
  run.observe([&](const HapticSample& sample) {
    const FingerContact& contact = sample.contact.fingers[0];
    if (sample.tick.time > kRest) {
      const double work = 0.5 * (contact.f_H_W + last_f).dot(contact.p_WH - last_p);
      net += work;
      moved += std::abs(work);
      gained.x.push_back(sample.tick.time);
      gained.y.push_back(1e6 * net);
    }
    last_p = contact.p_WH;
    last_f = contact.f_H_W;
  });
  run.run();
  Finding share = finding("energy gained in five laps, of the work moved", 100 * net / moved, "%", 0.05,
                          "none: the force is the gradient of a stored energy");
  share.plot_x = "time [s]";
  share.plot_y = "energy gained [uJ]";
  share.curves.push_back(decimated(std::move(gained)));
  return {share};
}

}  // namespace

Case make() {
  Case result;
  result.name = "texture_loops";
  result.title = "A finger strokes textures and layers in circles";
  result.source =
      "A texture that changes the depth and not the direction of the force, or begins with a step, feeds a hand that "
      "goes round: stored energy is the only height field that does not.";
  result.oracle = "Over a closed path the finger gains no energy; the trapezium rule and the ticks leave a rest.";
  result.scene = "texture_loops.xml";
  for (const Surface& surface :
       {texture("sine", "0.0001", "0.002"), texture("sine", "0.0001", "0.001"), texture("grid", "0.0001", "0.002"),
        texture("noise", "0.0002", "0.002"), image(), materialImage(), meshMaterial(), overLayers({"", kNone, {}}),
        overLayers(texture("sine", "0.0001", "0.002")), perturbation(ours()),
        perturbation({"printed formula", {"material/stone/perturbation/form=printed"}})}) {
    for (const bool touch_and_go : {false, true}) {
      // on a smooth face, a circle moves no work
      if (surface.wavelength == kNone && !touch_and_go) continue;
      for (const std::string rate : {"1000", "2000"}) {
        Trial trial;
        trial.parameters = {{"surface", surface.name},
                            {"wavelength", surface.wavelength},
                            {"path", touch_and_go ? "touch and go" : "on the face"},
                            {"rate", number(std::stod(rate) / 1000) + " kHz"}};
        trial.method = surface.method.name;
        // it pays 1.7 % on the way round, and takes as much on the way back; deep below the face it has an energy
        if (!surface.method.own() && touch_and_go) trial.expected = Verdict::kUnstable;
        trial.run = [=] { return stroke(surface, touch_and_go, rate); };
        trial.quick = rate == "1000";
        result.trials.push_back(std::move(trial));
      }
    }
  }
  return result;
}

}  // namespace presa::stability::texture_loops
