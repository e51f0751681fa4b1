#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "experiments/stability/cases.h"
#include "experiments/study/prescribed_finger.h"

namespace presa::stability::thin_plate {
namespace {

constexpr int kApproaches = 1000;
constexpr double kSpeed = 1;         // [m/s]
constexpr double kDepth = 0.1;       // target depth of the fingertip's centre below the upper face [m]
constexpr double kHeight = 0.03;     // start height of an approach [m]
constexpr double kRadius = 0.008;    // of the fingertip [m]
constexpr double kStiffness = 1000;  // of the scene [N/m]
constexpr double kReach = 0.2;       // approaches start within this distance of the middle [m]
constexpr double kMaxLean_deg = 60;  // from the vertical
constexpr double kStay = 0.005;      // at the bottom [s]

/// A path of straight segments through given points at constant speed.
class Polyline {
 public:
  void go(const Vec3& p) {
    if (!points_.empty()) times_.push_back(times_.back() + std::max((p - points_.back()).norm(), 1e-9) / kSpeed);
    if (points_.empty()) times_.push_back(0);
    points_.push_back(p);
  }
  void stay(double time) {
    times_.push_back(times_.back() + time);
    points_.push_back(Vec3(points_.back()));
  }
  double end() const { return times_.back(); }
  PrescribedFinger::State at(double time) const {
    const auto next = std::upper_bound(times_.begin(), times_.end(), time);
    if (next == times_.begin()) return {points_.front(), Vec3::Zero()};
    if (next == times_.end()) return {points_.back(), Vec3::Zero()};
    const auto i = static_cast<std::size_t>(next - times_.begin());
    const double span = times_[i] - times_[i - 1], s = (time - times_[i - 1]) / span;
    const Vec3 way = points_[i] - points_[i - 1];
    return {points_[i - 1] + s * way, way / span};
  }

 private:
  std::vector<Vec3> points_;
  std::vector<double> times_;
};

struct Approaches {
  Polyline way;
  std::vector<double> deepest;  ///< times of the deepest points [s]
};

Approaches approaches(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11U) * 0x1p-53;
  };
  Approaches all;
  all.way.go({0, 0, kHeight});
  for (int i = 0; i < kApproaches; ++i) {
    const Vec3 start(uniform(-kReach, kReach), uniform(-kReach, kReach), kHeight);
    const double lean = uniform(0, kMaxLean_deg) * std::numbers::pi / 180, turn = uniform(0, 2 * std::numbers::pi);
    const Vec3 aside = std::tan(lean) * Vec3(std::cos(turn), std::sin(turn), 0);
    const Vec3 bottom = start + (kHeight + kDepth) * (aside - Vec3::UnitZ());
    all.way.go(start);
    all.way.go(bottom);
    all.deepest.push_back(all.way.end());
    all.way.stay(kStay);
    all.way.go(start);
  }
  return all;
}

std::vector<Finding> push(const std::string& scene, const std::string& renderer) {
  const Approaches all = approaches(1);
  DeviceList devices;
  devices.push_back(std::make_unique<PrescribedFinger>([&](double time) { return all.way.at(time); }));
  StudyRun run(specOf(scene, {"haptics/renderer=" + renderer}, all.way.end()), std::move(devices));
  int through = 0;
  double worst = 0;
  std::size_t next = 0;
  const double wanted = kStiffness * (kDepth + kRadius);
  Curve force{"force away from the plate", {}, {}};
  run.observe([&](const HapticSample& sample) {
    const FingerContact& contact = sample.contact.fingers[0];
    if (sample.tick.time < 1.5) {
      force.x.push_back(sample.tick.time);
      force.y.push_back(contact.f_H_W.z());
    }
    if (next == all.deepest.size() || sample.tick.time < all.deepest[next]) return;
    ++next;
    if (contact.f_H_W.z() <= 0) ++through;
    worst = std::max(worst, (contact.f_H_W - wanted * Vec3::UnitZ()).norm() / wanted);
  });
  run.run();
  if (next != all.deepest.size()) throw std::logic_error("an approach was not seen");

  Finding count = finding("approaches that went through, of 1000", through, "", 0, "the finger never passes the plate");
  count.plot_x = "time [s]";
  count.plot_y = "force up on the finger [N]";
  count.curves.push_back(decimated(std::move(force)));
  return {count, finding("force error at the deepest point", 100 * worst, "%", 0.1,
                         "k (depth + radius) = " + number(wanted) + " N, straight up")};
}

}  // namespace

Case make() {
  Case result;
  result.name = "thin_plate";
  result.title = "A finger is pushed 100 mm through a plate of 0.5 mm";
  result.source =
      "Pop-through, which the god-object of Zilles and Salisbury 1995 solves; 1 m/s is two plates per tick.";
  result.oracle = "From 1000 random places and angles the finger stays on its side, with the force of a half-space.";
  result.scene = "thin_plate.xml";
  for (const bool mesh : {false, true}) {
    for (const std::string renderer : {"god_object", "penalty", "scp", "intermediate", "fca_mesh"}) {
      if (renderer == "fca_mesh" && !mesh) continue;
      Trial trial;
      trial.parameters = {{"plate", mesh ? "mesh" : "box"}};
      trial.method = renderer == "god_object" ? kPresa : renderer;
      // the surface nearest to the device is the far one; the point of fca_mesh lies a radius deeper than the fingertip
      trial.expected = renderer == "penalty" || renderer == "fca_mesh" ? Verdict::kUnstable : Verdict::kStable;
      trial.run = [=] { return push(mesh ? "thin_plate.xml" : "thin_plate_box.xml", renderer); };
      trial.quick = true;
      result.trials.push_back(std::move(trial));
    }
  }
  return result;
}

}  // namespace presa::stability::thin_plate
