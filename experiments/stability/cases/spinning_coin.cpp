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
  explicit Watched(const std::vector<std::string>& sets, double duration = kDuration)
      : run_(specOf("spinning_coin.xml", sets, duration)), coin_(bodyNamed(run_.world(), "coin")) {
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
  /// Time at which it has come down to `tilt` [deg]; NaN: it has not.
  double downTo(double tilt) const {
    for (std::size_t k = 0; k < tilt_.x.size(); ++k) {
      if (tilt_.y[k] < tilt) return tilt_.x[k];
    }
    return NAN;
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

constexpr double kRadius = 0.0375, kThickness = 0.0002;  // of the disk [m]

/// Starts in steady rolling with its centre at rest.
std::vector<std::string> disk(double rate, double tilt_deg) {
  const double tilt = std::numbers::pi / 180 * tilt_deg, sine = std::sin(tilt), cosine = std::cos(tilt);
  const double turn = std::sqrt(4 * kGravity / (kRadius * sine)) * sine;
  const std::string shape = number(kRadius), length = number(kThickness);
  return {"rates/dynamics=" + number(rate),
          "body/coin/physics/cylinder/radius=" + shape,
          "body/coin/physics/cylinder/length=" + length,
          "body/coin/euler_deg=" + number(tilt_deg) + " 0 0",
          "body/coin/pos=0 0 " + number(kRadius * sine + kThickness / 2 * cosine),
          "body/coin/angular_velocity=0 " + number(turn * cosine) + " " + number(turn * sine)};
}

std::vector<Finding> rollDisk(double rate, double tilt_deg) {
  Watched rolling(disk(rate, tilt_deg));
  rolling.run();
  return {rolling.eulersDisk(kRadius), rolling.energyRise()};
}

constexpr double kFlat = 1;        // tilt at which it counts as lying [deg]
constexpr double kCloth = 0.0002;  // rolling resistance of a coin on cloth [m]

/// Energy (3/2) m g a sin(tilt) of the disk against the power of rolling resistance, length * m g * W sin(tilt) cos(tilt):
///   tilt' = -(4 length / (3 a)) sqrt(g sin(tilt) / a), integrated in steps of a thousandth of the tilt.
double timeToLie(double tilt_deg, double length) {
  constexpr int kParts = 1000;
  const double from = std::numbers::pi / 180 * kFlat, to = std::numbers::pi / 180 * tilt_deg;
  double sum = 0;
  const double part = (to - from) / kParts;
  for (int i = 0; i < kParts; ++i) sum += part / std::sqrt(std::sin(from + (i + 0.5) * part));
  return sum * 3 * kRadius / (4 * length) * std::sqrt(kRadius / kGravity);
}

std::vector<Finding> layDisk(double rate, double tilt_deg, double length) {
  std::vector<std::string> sets = disk(rate, tilt_deg);
  sets.push_back("material/table/friction/rolling=" + number(length));
  const double wanted = timeToLie(tilt_deg, length);
  Watched rolling(sets, 2 * wanted);
  rolling.run();
  return {finding("time until it lies", 100 * (rolling.downTo(kFlat) / wanted - 1), "%", 20,
                  "rolling resistance takes 3/2 m g a sin(tilt): " + number(std::round(100 * wanted) / 100) + " s"),
          rolling.energyRise()};
}

/// A coin on a cloth, beside the same with a step of 0.5 ms.
std::vector<Finding> layCoin(double spin) {
  const auto lies = [&](double rate) {
    Watched coin({"rates/haptic=" + number(std::max(1000.0, rate)), "rates/dynamics=" + number(rate),
                  "body/coin/angular_velocity=0 0 " + number(spin),
                  "material/table/friction/rolling=" + number(kCloth)});
    coin.run();
    return coin.downTo(kFlat);
  };
  return {finding("time until it lies", 100 * (lies(200) / lies(2000) - 1), "%", 20, "the same with a step of 0.5 ms")};
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
      "The lowest point of a rim runs around faster than the body turns: where contacts stay in place within a "
      "step, the rim sinks in and the energy rises by up to 11 %. Euler's disk: H. K. Moffatt, Nature 404 (2000), 833.";
  result.oracle =
      "The energy never rises; a disk that rolls with its centre at rest keeps W^2 sin(tilt) = 4 g / a, and rolling "
      "resistance lays it down in the time that takes its energy.";
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
    for (const double length : {0.0005, 0.002}) {
      const std::string start = "disk at 15 deg, rolling resistance " + number(1000 * length) + " mm";
      result.trials.push_back(trialOf({step, {"start", start}}, [=] { return layDisk(rate, 15, length); }));
    }
  }
  for (const double spin : {20.0, 40.0, 80.0}) {
    result.trials.push_back(trialOf({{"step", "5 ms"}, {"start", "spin " + number(spin) + " rad/s on cloth"}},
                                    [=] { return layCoin(spin); }));
  }
  return result;
}

}  // namespace presa::stability::spinning_coin
