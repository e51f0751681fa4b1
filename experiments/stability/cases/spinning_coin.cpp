#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiments/stability/bodies.h"
#include "experiments/stability/cases.h"

namespace presa::stability::spinning_coin {
namespace {

constexpr double kGravity = 9.81, kDuration = 5, kWindow = 0.5;

/// A coin or disk on its rim, as it is watched.
class Watched {
 public:
  explicit Watched(const std::vector<std::string>& sets)
      : run_(specOf("spinning_coin.xml", sets, kDuration)), coin_(bodyNamed(run_.world(), "coin")) {
    run_.observe(atEachStep([this](const ObjectState& state) { see(state); }));
  }
  void run() { run_.run(); }

  Finding energyRise() {
    Finding rise = finding("rise of the energy", 100 * rise_, "%", 0.2,
                           "friction and impacts only take energy; in relation to the energy at the start");
    rise.plot_x = "time [s]";
    rise.plot_y = "tilt [deg]";
    rise.curves = {decimated(tilt_)};
    return rise;
  }
  /// Relative error of W^2 sin(tilt) = 4 g / radius, with W the rate at which the axis goes round.
  Finding eulersDisk(double radius) const {
    return finding("rate beside Euler's disk", 100 * error(radius), "%", 2,
                   "W^2 sin(tilt) = 4 g / a, in the first half second: friction takes the steady motion away");
  }

 private:
  void see(const ObjectState& state) {
    const BodyMotion& body = state.bodies[coin_];
    const BodyInertia& inertia = run_.world().inertias[coin_];
    const Vec3 w_B = body.X_WB_end.q.conjugate() * body.w_WB;
    const double energy = inertia.mass * body.v_WB.squaredNorm() / 2 + w_B.dot(inertia.inertia * w_B) / 2 +
                          inertia.mass * kGravity * body.X_WB_end.p.z();
    if (tilt_.x.empty()) first_ = lowest_ = energy;
    lowest_ = std::min(lowest_, energy);
    rise_ = std::max(rise_, (energy - lowest_) / first_);
    const Vec3 axis = body.X_WB_end.q * Vec3::UnitZ();
    const double azimuth = std::atan2(axis.y(), axis.x());
    const double before = azimuth_.empty() ? azimuth : azimuth_.back();
    azimuth_.push_back(before + std::remainder(azimuth - before, 2 * std::numbers::pi));
    tilt_.x.push_back(state.time_end);
    tilt_.y.push_back(180 / std::numbers::pi * std::atan2(axis.head<2>().norm(), std::abs(axis.z())));
  }
  double error(double radius) const {
    std::size_t k = 0;
    double sine = 0;
    while (tilt_.x[k] < kWindow) sine += std::sin(std::numbers::pi / 180 * tilt_.y[k++]);
    const double rate = (azimuth_[k] - azimuth_[0]) / (tilt_.x[k] - tilt_.x[0]);
    return std::abs(rate * rate * sine / double(k) * radius / (4 * kGravity) - 1);
  }

  StudyRun run_;
  std::size_t coin_;
  double first_ = 0, lowest_ = 0, rise_ = 0;
  std::vector<double> azimuth_;  // of the axis, continuous [rad]
  Curve tilt_{"tilt", {}, {}};
};

std::vector<Finding> spinCoin(double rate, double spin) {
  Watched coin({"rates/dynamics=" + number(rate), "body/coin/angular_velocity=0 0 " + number(spin)});
  coin.run();
  return {coin.energyRise()};
}

/// Starts in steady rolling with its centre at rest.
std::vector<Finding> rollDisk(double rate, double tilt_deg) {
  constexpr double kRadius = 0.0375, kThickness = 0.0002;  // [m]
  const double tilt = std::numbers::pi / 180 * tilt_deg, sine = std::sin(tilt), cosine = std::cos(tilt);
  const double turn = std::sqrt(4 * kGravity / (kRadius * sine)) * sine;
  const std::string shape = number(kRadius), length = number(kThickness);
  Watched disk({"rates/dynamics=" + number(rate), "body/coin/physics/cylinder/radius=" + shape,
                "body/coin/physics/cylinder/length=" + length, "body/coin/euler_deg=" + number(tilt_deg) + " 0 0",
                "body/coin/pos=0 0 " + number(kRadius * sine + kThickness / 2 * cosine),
                "body/coin/angular_velocity=0 " + number(turn * cosine) + " " + number(turn * sine)});
  disk.run();
  return {disk.eulersDisk(kRadius), disk.energyRise()};
}

Trial trialOf(Parameters parameters, std::function<std::vector<Finding>()> run) {
  Trial trial;
  trial.parameters = std::move(parameters);
  trial.method = kPresa;
  trial.run = std::move(run);
  return trial;
}

}  // namespace

Case make() {
  Case result;
  result.name = "spinning_coin";
  result.title = "A coin of 24 x 2 mm is spun on its rim; a thin disk of 75 mm rolls round and round";
  result.source =
      "The lowest point of a rim runs around faster than the body turns: where contacts stay in place within a step, "
      "the "
      "rim sinks in and the energy rises by up to 11 %. Euler's disk: H. K. Moffatt, Nature 404 (2000), 833.";
  result.oracle = "The energy never rises; a disk that rolls with its centre at rest keeps W^2 sin(tilt) = 4 g / a.";
  result.scene = "spinning_coin.xml";
  for (const double rate : {200.0, 1000.0}) {
    const std::pair<std::string, std::string> step{"step", number(1000 / rate) + " ms"};
    for (const double spin : {20.0, 40.0, 80.0}) {
      result.trials.push_back(
          trialOf({step, {"start", "spin " + number(spin) + " rad/s"}}, [=] { return spinCoin(rate, spin); }));
      result.trials.back().quick = rate < 500;
    }
    for (const double tilt : {15.0, 30.0}) {
      result.trials.push_back(
          trialOf({step, {"start", "disk at " + number(tilt) + " deg"}}, [=] { return rollDisk(rate, tilt); }));
    }
  }
  return result;
}

}  // namespace presa::stability::spinning_coin
