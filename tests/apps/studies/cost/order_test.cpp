// The observed order of convergence equals that of the method, in scenes with known answers.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <fstream>

#include "apps/studies/cost/driver.h"
#include "apps/studies/cost/plan.h"
#include "experiments/study/energy_ledger.h"
#include "experiments/study/free_motion.h"
#include "experiments/study/prescribed_finger.h"
#include "experiments/study/study_run.h"
#include "tests/apps/support/support.h"

namespace presa::cost {
namespace {

using test::scratch;

std::string write(const std::string& name, const std::string& text) {
  const std::string file = scratch(name);
  std::ofstream(file) << text;
  return file;
}

std::string scene(const std::string& gravity, const std::string& body_attributes, const std::string& physics) {
  return R"(<scene version="1.0" name="free"><world gravity=")" + gravity + R"("/><rates haptic="1000" dynamics="200"/>
    <materials><material name="m" stiffness="1000"/></materials>
    <body name="body" )" +
         body_attributes + "><physics mass=\"0.2\">" + physics + "</physics></body></scene>";
}

std::string study(const std::string& scene_file, const std::string& rates) {
  return R"(<accuracy_cost version="1.0" name="order" scene=")" + scene_file +
         R"(" duration="1" repeats="1" compared_from="0.2">
    <reference kind="analytic"/><grid><knob name="dynamics_rate" values=")" +
         rates + R"("/></grid></accuracy_cost>)";
}

Result run(const std::string& name, const std::string& study_xml) {
  Diagnostics diagnostics;
  const Study planned = planStudy({.input = write(name + ".xml", study_xml), .out = scratch(name)}, diagnostics);
  if (diagnostics.hasErrors()) throw InputError(diagnostics);
  checkFolder(planned, diagnostics);
  return runStudy(planned, {.workers = 2});
}

double orderOf(const Result& result, const std::string& metric, const std::string& knob) {
  for (const presa::cost::Order& each : result.orders)
    if (each.factor == knob && each.metric == metric) return each.order;
  return 0;
}

// Semi-implicit Euler: p_n = p(t) + g t h / 2, first order.
TEST(Order, FreeFallIsOfFirstOrder) {
  const Result result =
      run("fall", study(write("fall_scene.xml", scene("0 0 -9.81", "pos=\"0 0 0\"", "<sphere radius=\"0.05\"/>")),
                        "50,100,200,500,1000"));
  EXPECT_NEAR(orderOf(result, "position", "dynamics_rate"), 1, 0.02);
  // the error agrees with theory: RMS of g t h / 2 over 0.2 … 1 s at h = 5 ms, within the resolution of the grid
  const double rms = 1e3 * 9.81 * 0.005 / 2 * std::sqrt((1 - 0.008) / 3 / 0.8);
  EXPECT_NEAR(result.outcomes.front().error.at("position"), rms, 0.02 * rms);
  // the same scheme loses an energy of m g² h t / 2, up to rounding
  EXPECT_NEAR(result.outcomes.front().error.at("energy_drift"), 1e3 * 0.2 * 9.81 * 9.81 * 0.005 * 0.995 / 2, 1e-6);
  EXPECT_LT(result.outcomes.front().error.at("energy_created"), 1e-9);
}

// One Runge–Kutta step of the exact rotation is of fourth order, as long as it is not subdivided (from 25 mrad on).
TEST(Order, TheExactRotationIsOfFourthOrder) {
  const Result result = run("spin", study(write("spin_scene.xml", scene("0 0 0", "angular_velocity=\"0.6 1.0 0.3\"",
                                                                        "<box size=\"0.02 0.06 0.12\"/>")),
                                          "100,200,500"));
  EXPECT_NEAR(orderOf(result, "angle", "dynamics_rate"), 4, 0.2);
}

// The analytic reference against the closed form of a symmetric top: spin about its axis, precession about the
// angular momentum.
TEST(Order, TheAnalyticRotationFollowsTheSymmetricTop) {
  Diagnostics diagnostics;
  const Loaded loaded = loadWorld(
      {write("top.xml", scene("0 0 0", "angular_velocity=\"3 0 20\"", "<cylinder radius=\"0.05\" length=\"0.02\"/>")),
       "",
       {}},
      {}, diagnostics);
  ASSERT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
  const Mat3& inertia = loaded.world->inertias[0].inertia;
  const Vec3 momentum = inertia * Vec3(3, 0, 20);
  const double precession = momentum.norm() / inertia(0, 0), spin = 20 - 20 * inertia(2, 2) / inertia(0, 0);
  FreeMotion motion(loaded.world);
  for (const double time : {0.1, 1.0, 3.0}) {
    const Quat expected = Quat(Eigen::AngleAxisd(precession * time, momentum.normalized())) *
                          Quat(Eigen::AngleAxisd(spin * time, Vec3::UnitZ()));
    EXPECT_LT(motion.at(0, time).q.angularDistance(expected), 1e-9) << time;
  }
}

/// Closed form: displacement of a mass m on the spring (k, d) of a finger that moves by A (1 − cos ωt) from
/// equilibrium.
double massOnFinger(double m, double k, double d, double amplitude, double w, double t) {
  using Complex = std::complex<double>;
  const Complex gain = Complex(k, w * d) / Complex(k - m * w * w, w * d);
  const double decay = d / (2 * m), free = std::sqrt(k / m - decay * decay);
  // y = A − A Re(H e^{iωt}) + e^{−δt}(a cos + b sin), at rest at 0
  const double a = -amplitude + amplitude * gain.real();
  const double b = (decay * a - amplitude * w * gain.imag()) / free;
  return amplitude - amplitude * (gain * std::polar(1.0, w * t)).real() +
         std::exp(-decay * t) * (a * std::cos(free * t) + b * std::sin(free * t));
}

struct Ride {
  double error = 0;    ///< RMS error of the cube's height [m]
  double created = 0;  ///< created energy [J]
};

Ride ride(const std::string& scene_file, double dynamics_rate, const std::string& coupling) {
  constexpr double kMass = 0.2, kStiffness = 1000, kDamping = 2, kStroke = 0.002, kOmega = 12, kRadius = 0.008;
  const double depth = kMass * 9.81 / kStiffness;
  DeviceList devices;
  devices.push_back(std::make_unique<PrescribedFinger>([=](double t) {
    return PrescribedFinger::State{Vec3(0, 0, depth - kRadius + kStroke * (1 - std::cos(kOmega * t))),
                                   Vec3(0, 0, kStroke * kOmega * std::sin(kOmega * t))};
  }));
  StudyRun run({.scene = scene_file,
                .sets = {"rates/haptic=8000", "rates/dynamics=" + std::to_string(dynamics_rate),
                         "dynamics/coupling=" + coupling},
                .duration = 1},
               std::move(devices));
  EnergyLedger ledger(std::make_shared<const World>(run.world()));
  double squares = 0;
  int count = 0;
  run.observe([&](const HapticSample& sample) {
    if (sample.tick.time > 0.3) ledger.observe(sample);  // without the output stage's soft start
    const double time = sample.objects->time_begin;
    if (std::abs(time - sample.tick.time) > 1e-9) return;
    const double error = sample.objects->bodies[0].X_WB_begin.p.z() - 0.03 -
                         massOnFinger(kMass, kStiffness, kDamping, kStroke, kOmega, time);
    squares += error * error;
    ++count;
  });
  run.run();
  return {std::sqrt(squares / count), ledger.created()};
}

// A cube riding on a moving fingertip: implicit Euler of the finger's spring is of first order.
TEST(Order, TheFingerSpringIsOfFirstOrder) {
  const std::string file =
      write("ride.xml", R"(<scene version="1.0" name="ride" rig="ride_rig.xml"><world gravity="0 0 -9.81"/>
    <materials><material name="m" stiffness="1000" damping="2"/></materials>
    <body name="cube" pos="0 0 0.03"><haptic><box size="0.06 0.06 0.06"/></haptic><physics mass="0.2"><box size="0.06 0.06 0.06"/></physics></body>
    <devices><device role="thumb"><limits force="50" force_rate="1e6"/></device></devices></scene>)");
  // placeholder rig: the prescribed finger replaces its finger
  write("ride_rig.xml",
        R"(<rig version="1.0" name="ride"><device role="thumb" driver="scripted"><set key="motion" value=")" +
            test::source("config/motions/hover.csv") + R"("/></device></rig>)");
  const Ride coarse = ride(file, 200, "soft"), fine = ride(file, 800, "soft");
  EXPECT_NEAR(std::log(coarse.error / fine.error) / std::log(4.0), 1, 0.2) << coarse.error << ' ' << fine.error;
  // an implicit spring creates no energy; an explicit one does, more with a coarser step
  const double rough = ride(file, 100, "explicit").created, finer = ride(file, 800, "explicit").created;
  RecordProperty("created", std::to_string(coarse.created) + " " + std::to_string(rough) + " " + std::to_string(finer));
  EXPECT_LT(coarse.created, 0.1 * rough);
  EXPECT_LT(finer, 0.5 * rough);
}

}  // namespace
}  // namespace presa::cost
