#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <random>

#include "experiments/stability/cases.h"
#include "experiments/stability/grip.h"
#include "experiments/stability/methods.h"

namespace presa::stability::random_grasping {
namespace {

constexpr int kDraws = 5;   // grasps in a trial, of 5 s each
constexpr int kSeeds = 12;  // trials with Presa's method: five simulated minutes
constexpr double kGravity = 9.81, kMaxShake = 5, kMaxAmplitude = 0.015, kMaxDepth = 0.006;  // [m/s^2, m/s^2, m, m]

/// The number of trials: more of them by PRESA_RANDOM_SEEDS.
std::uint64_t seeds() {
  const char* text = std::getenv("PRESA_RANDOM_SEEDS");
  const int wanted = text != nullptr ? std::atoi(text) : 0;
  return static_cast<std::uint64_t>(wanted > 0 ? wanted : kSeeds);
}

class Draws {
 public:
  explicit Draws(std::uint64_t seed) : random_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(random_() >> 11U) * 0x1p-53;
  }
  double logUniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  Vec3 direction() {
    for (;;) {
      const Vec3 v(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
      if (v.norm() > 0.1 && v.norm() < 1) return v.normalized();
    }
  }

 private:
  std::mt19937_64 random_;
};

std::string text(const Vec3& v) { return number(v.x()) + " " + number(v.y()) + " " + number(v.z()); }

/// Fingertips on the faces -x and +x, on a line through the brick when there are two, else apart along y.
void place(Grip& grip, int low, int high, const Vec3& size, double height) {
  for (const double side : {-1.0, 1.0}) {
    const int count = side < 0 ? low : high;
    for (int i = 0; i < count; ++i) {
      const double y = count == 1 ? 0 : (i - 0.5 * (count - 1)) * size.y() / 2;
      grip.points.emplace_back(side * size.x() / 2, y, height);
      grip.normals.emplace_back(side * Vec3::UnitX());
    }
  }
}

/// A grasp that holds what it must: twice the grip that weight and shaking need.
Carried drawn(Draws& draw, const Method& method) {
  Carried carried;
  carried.scene = "random_grasping.xml";
  carried.body = "brick";
  carried.stiffness = draw.logUniform(500, 10'000);
  const double friction = draw.uniform(0.5, 1);
  const Vec3 size(draw.uniform(0.03, 0.09), draw.uniform(0.04, 0.12), draw.uniform(0.03, 0.09));
  const double carries = 0.9 * friction * carried.stiffness / (kGravity + kMaxShake);  // mass for each metre of depth
  const double mass = draw.logUniform(0.002, std::min(0.5, carries * kMaxDepth));
  Grip& grip = carried.grip;
  grip.depth = std::max(0.002, mass / carries);
  const int fingers = static_cast<int>(draw.uniform(2, 5)), high = fingers == 2 ? 1 : 2, low = fingers - high;
  // two fingertips above the middle: the brick hangs between them
  const double above = fingers == 2 ? draw.uniform(0.002, 0.008) : draw.uniform(-0.005, 0.005);
  grip.waiting = static_cast<std::size_t>(4 - fingers);
  place(grip, low, high, size, size.z() / 2 + above);
  const double frequency = draw.uniform(1, 4), omega = 2 * std::numbers::pi * frequency;
  const Vec3 amplitude = std::min(kMaxAmplitude, kMaxShake / (omega * omega)) * draw.direction();
  grip.move = [=](std::size_t, double time) { return shaken(amplitude, frequency, time); };
  carried.oracle = "the brick at rest on its springs, from the geometry of the grasp";
  carried.sets = std::vector<std::string>{"body/brick/pos=0 0 " + number(size.z() / 2),
                                          "body/brick/haptic/box/size=" + text(size),
                                          "body/brick/physics/box/size=" + text(size),
                                          "body/brick/physics/mass=" + number(mass),
                                          "material/skin/stiffness=" + number(carried.stiffness),
                                          "material/skin/friction/dynamic=" + number(0.9 * friction),
                                          "material/skin/friction/static=" + number(friction)} +
                 method;
  return carried;
}

/// The worst of each finding.
std::vector<Finding> grasp(std::uint64_t seed, const Method& method) {
  Draws draw(seed);
  std::vector<Finding> worst;
  for (int i = 0; i < kDraws; ++i) {
    std::vector<Finding> now = carry(drawn(draw, method));
    if (worst.empty()) worst = now;
    for (std::size_t f = 0; f < now.size(); ++f) {
      if (!(now[f].value <= worst[f].value)) worst[f] = now[f];
    }
  }
  return worst;
}

}  // namespace

Case make() {
  Case result;
  result.name = "random_grasping";
  result.title =
      "Bricks of random size, mass and friction in two to four fingers, shaken at random, five minutes in all";
  result.source =
      "Hand-picked cases miss what nobody thought of; the reference, equations of motion on springs, knows the "
      "answer for any draw.";
  result.oracle =
      "The brick follows its equations of motion, integrated at 10 us, and each finger presses as statics says.";
  result.scene = "random_grasping.xml";
  const auto add = [&result](std::uint64_t seed, const Method& method) {
    Trial trial;
    trial.parameters = {{"seed", number(static_cast<double>(seed))}, {"coupling", couplingOf(method)}};
    trial.method = method.name;
    if (!method.own()) trial.expected = Verdict::kUnstable;
    trial.run = [=] { return grasp(seed, method); };
    trial.quick = seed == 1 && method.own();
    result.trials.push_back(std::move(trial));
  };
  for (std::uint64_t seed = 1; seed <= seeds(); ++seed) {
    add(seed, ours());
    add(seed, hapticRate());
  }
  for (std::uint64_t seed = 1; seed <= 2; ++seed) add(seed, explicitCoupling());
  return result;
}

}  // namespace presa::stability::random_grasping
