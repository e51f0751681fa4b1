#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <numbers>

#include "experiments/stability/cases.h"
#include "experiments/stability/folder.h"
#include "experiments/study/prescribed_finger.h"
#include "framework/geometry/obj_text.h"
#include "framework/haptics/virtual_coupling.h"

namespace presa::stability::ray_loops {
namespace {

constexpr double kPeriod = 4, kRest = 1.5, kLaps = 3;  // of a lap; before the first one [s]; laps
constexpr double kBall = 0.02;                         // radius of the ball [m]
constexpr double kMu = 0.3;                            // of the rough ones
constexpr double kDown = 1;                            // in which the hand comes down [s]

/// The hand comes down, then its rod goes round in 4 s: the handle on an ellipse, the rod nodding and swaying.
PrescribedFinger::State swing(double time) {
  const auto at = [](double t) {
    const double angle = 2 * std::numbers::pi / kPeriod * std::max(0.0, t - kRest);
    const double down = std::min(1.0, t / kDown), soft = down * down * (3 - 2 * down);
    const double x = -0.08 + 0.004 * (std::cos(angle) - 1), y = 0.003 * std::sin(angle);
    const Quat lies(Eigen::AngleAxisd(0.5 * std::numbers::pi, Vec3::UnitY())),
        nods(Eigen::AngleAxisd(-0.052 + 0.01 * std::sin(angle), Vec3::UnitY())),
        sways(Eigen::AngleAxisd(0.02 * (std::cos(angle) - 1), Vec3::UnitZ()));
    return Pose{{x, y, 0.0365 + 0.03 * (1 - soft)}, sways * nods * lies};
  };
  constexpr double kStep = 1e-6;
  const Pose now = at(time), next = at(time + kStep);
  return {now.p, (next.p - now.p) / kStep, now.q, turnBetween(now.q, next.q) / kStep};
}

std::vector<Finding> round(int subdivisions, const std::string& rate, const std::string& friction) {
  const Folder folder("ray_loops");
  const std::string ball = folder.file("ball.obj");
  std::ofstream(ball) << objText(makeSphere(kBall, subdivisions), 9);
  DeviceList devices;
  devices.push_back(std::make_unique<PrescribedFinger>(swing));
  StudyRun run(specOf("ray_loops.xml",
                      {"body/other/haptic/mesh/file=" + ball, "body/other/haptic/mesh/scale=1 1 1",
                       "body/other/pos=0.045 0 0.028", "rates/haptic=" + rate,
                       "material/stone/friction/static=" + friction, "material/stone/friction/dynamic=" + friction},
                      kRest + kLaps * kPeriod),
               std::move(devices));
  double net = 0, moved = 0, step = 0, largest = 0, beyond = 0;
  Pose last;
  Vec3 last_f = Vec3::Zero(), last_t = Vec3::Zero();
  Curve gained{"energy that the hand has gained", {}, {}};
  run.observe([&](const HapticSample& sample) {
    const FingerContact& contact = sample.contact.fingers[0];
    const PrescribedFinger::State hand = swing(sample.tick.time);
    if (sample.tick.time > kRest) {
      const double work = 0.5 * ((contact.f_H_W + last_f).dot(hand.p_WH - last.p) +
                                 (contact.t_H_W + last_t).dot(turnBetween(last.q, *hand.q_WT)));
      net += work;
      moved += std::abs(work);
      step = std::max(step, (contact.f_H_W - last_f).norm());
      largest = std::max(largest, contact.f_H_W.norm());
      std::array<double, 2> pressure{}, sideways{};  // by body; neither is turned
      for (const ToolContact& one : sample.contact.contactsOf(contact)) {
        const double along = one.f_H_W.dot(one.nhat_B);
        pressure.at(static_cast<std::size_t>(one.body)) += along;
        sideways.at(static_cast<std::size_t>(one.body)) += (one.f_H_W - along * one.nhat_B).norm();
      }
      for (std::size_t b = 0; b < 2; ++b) {
        beyond = std::max(beyond, sideways[b] - kMu * pressure[b]);
      }
      gained.x.push_back(sample.tick.time);
      gained.y.push_back(1e6 * net);
    }
    last = {hand.p_WH, *hand.q_WT};
    last_f = contact.f_H_W;
    last_t = contact.t_H_W;
  });
  run.run();
  const bool smooth = friction == "0";
  Finding share = finding("energy gained in three laps, of the work moved", std::max(0.0, 100 * net / moved), "%", 0.05,
                          "none; " + number(std::max(0.0, -100 * net / moved)) + " % went into " +
                              (smooth ? "snaps from edge to edge" : "friction"));
  share.plot_x = "time [s]";
  share.plot_y = "energy gained [uJ]";
  share.curves.push_back(decimated(std::move(gained)));
  if (smooth)
    return {share, finding("largest step of the force, of the largest force", 100 * step / largest, "%", 15,
                           "a frictionless line snaps from edge to edge of a coarse mesh")};
  return {share, finding("friction beyond the cone of a body, of the largest force", 100 * beyond / largest, "%", 5,
                         "Coulomb: at most mu times the normal force")};
}

}  // namespace

Case make() {
  Case result;
  result.name = "ray_loops";
  result.title = "A rod goes round on the meshes of a cup and a ball";
  result.source =
      "A line is held at its ends, along its side and on edges by turns. Where one takes over from another, a force "
      "that is not the slope of one energy would feed the hand.";
  result.oracle = "Over closed paths the hand gains no energy, and no place that takes over makes a jump.";
  result.scene = "ray_loops.xml";
  for (const int subdivisions : {3, 5, 7}) {
    for (const std::string& friction : {std::string("0"), number(kMu)}) {
      for (const std::string rate : {"1000", "4000"}) {
        Trial trial;
        trial.parameters = {{"triangles of the ball", std::to_string(20 << (2 * subdivisions))},
                            {"friction", friction},
                            {"rate", number(std::stod(rate) / 1000) + " kHz"}};
        trial.method = kPresa;
        trial.run = [=] { return round(subdivisions, rate, friction); };
        trial.quick = rate == "1000" && subdivisions < 7;
        result.trials.push_back(std::move(trial));
      }
    }
  }
  return result;
}

}  // namespace presa::stability::ray_loops
