#pragma once
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiments/study/prescribed_finger.h"
#include "framework/session/load_world.h"
#include "framework/session/run.h"
#include "framework/session/session.h"
#include "modules/dynamics_ode/haptic_rate/held_bodies.h"
#include "tests/support/guarded_steps.h"

// Cubes in a session whose fingertips follow prescribed paths and whose dynamics have coupling haptic_rate.
namespace presa::held {

inline constexpr double kHalf = 0.02, kRadius = 0.008, kDepth = 0.002, kTick = 0.001;  // [m, m, m, s]

/// Sees the bodies as they are shown, and those that the haptic thread moves.
class HeldEye final : public Module {
 public:
  HeldEye() : Module("held_eye", RateGroup::kHaptic) {}
  void step(const Tick& tick) noexcept override {
    if (look) look(tick);
  }
  In<ObjectState> shown{*this, kShownObjectsPort};
  In<ode::HeldBodies> held{*this, ode::kHeldBodiesPort};
  In<ContactExchange> contact{*this, "contact_exchange"};
  std::function<void(const Tick&)> look;
};

inline const std::array<std::string, 3> kRoles{"thumb", "index", "middle"};

/// Free cubes of 40 mm and 0.1 kg at these x, on a floor or in free space.
inline std::string cubesXml(const std::vector<double>& at, bool floor, int max_held = 3, std::size_t fingers = 2) {
  const std::string box = "<box size=\"0.04 0.04 0.04\"/>";
  std::string xml =
      R"(<scene version="1.0" name="cubes"><world gravity="0 0 )" + std::string(floor ? "-9.81" : "0") +
      R"("/><dynamics coupling="haptic_rate" max_held=")" + std::to_string(max_held) +
      R"("/><materials><material name="skin" stiffness="2000" damping="2"><friction static="0.8"/></material></materials>)";
  if (floor) {
    xml +=
        R"(<body name="floor" fixed="true" material="skin" pos="0 0 -0.05"><physics><box size="4 4 0.1"/></physics></body>)";
  }
  for (std::size_t i = 0; i < at.size(); ++i) {
    xml += "<body name=\"cube" + std::to_string(i) + "\" material=\"skin\" pos=\"" + std::to_string(at[i]) +
           " 0 0.02\"><haptic>" + box + "</haptic><physics mass=\"0.1\">" + box + "</physics></body>";
  }
  xml += "<devices>";
  for (std::size_t f = 0; f < fingers; ++f) {
    xml += "<device role=\"" + kRoles.at(f) +
           "\" fingertip_radius=\"0.008\"><limits force=\"100\" force_rate=\"100000\"/></device>";
  }
  return xml + "</devices></scene>";
}

/// A session of that scene whose fingertips follow these paths.
struct Bench {
  Bench(const std::string& xml, const std::vector<PrescribedFinger::Path>& paths) {
    Diagnostics diagnostics;
    RunOptions options;
    options.bus = BusSettings{.network = "none"};
    std::string rig = "<rig version=\"1.0\" name=\"desk\">";
    for (std::size_t f = 0; f < paths.size(); ++f) rig += "<device role=\"" + kRoles.at(f) + "\" driver=\"scripted\"/>";
    Loaded loaded = loadWithoutDevices({xml, "cubes.xml", rig + "</rig>"}, options, diagnostics);
    if (diagnostics.hasErrors()) throw InputError(diagnostics);
    Session::Options session_options;
    for (const auto& path : paths) session_options.devices.push_back(std::make_unique<PrescribedFinger>(path));
    auto made = std::make_unique<HeldEye>();
    eye = made.get();
    session_options.more.push_back(std::move(made));
    session.emplace(std::move(loaded), control, std::move(session_options));
  }
  const BodyMotion& cube(std::size_t i) const { return eye->shown->bodies[i]; }
  RunControl control;
  HeldEye* eye = nullptr;
  std::optional<Session> session;
};

inline double smooth(double time, double begin, double end) {
  const double s = std::clamp((time - begin) / (end - begin), 0.0, 1.0);
  return s * s * (3 - 2 * s);
}

/// Differentiates a path.
inline PrescribedFinger::Path along(std::function<Vec3(double)> place) {
  return [place = std::move(place)](double t) {
    constexpr double kStep = 1e-6;
    return PrescribedFinger::State{place(t), (place(t + kStep) - place(t - kStep)) / (2 * kStep)};
  };
}

}  // namespace presa::held
