#include "devices/percro_arm/linked_arms.h"

#include <cmath>

#include "devices/percro_arm/steps.h"

namespace presa::percro {
namespace {

constexpr double kPeriod = 1e-3, kSettle = 0.5;  // [s]
constexpr int kTicksPerSample = 10;
// the joint between the tips: stiff compared with barrels and bearings
constexpr double kMass = 0.1, kStiffness = 50e3, kDamping = 100;

}  // namespace

Vec3 LinkPath::at(double time) const {
  const Vec3 angle = 2 * std::numbers::pi * time * rate + phase;
  return middle + amplitude.cwiseProduct(Vec3(angle.array().sin()));
}

LinkPath randomPath(RandomStream& stream, double size) {
  LinkPath path;
  for (int i = 0; i < 3; ++i) {
    path.amplitude[i] = size * stream.uniform(0.5, 1);
    path.rate[i] = stream.uniform(0.1, 0.4);
    path.phase[i] = stream.uniform(0, 2 * std::numbers::pi);
  }
  return path;
}

Vec3 linkCentre(const Vec3& p_DT, double link) { return p_DT + link * p_DT.normalized(); }
Vec3 tipOf(const Vec3& p_DC, double link) { return p_DC - link * p_DC.normalized(); }

bool meetAlong(const Geometry& geometry, const Pose& X_AB, const LinkPath& path, double link) {
  for (const double time : steps(0, path.duration, 1000)) {
    const Vec3 centre = path.at(time);
    for (const Vec3& p_DC : {centre, X_AB.inverseTimes(centre)}) {
      if (!withinReach(geometry, jointsAt(geometry, tipOf(p_DC, link)))) return false;
    }
  }
  return true;
}

std::vector<LinkedSample> moveLinked(const Parameters& parameters, const Vec3& gravity_A, const Pose& X_AB,
                                     const LinkPath& path, double link, const std::array<Vec3, 2>& zero_errors) {
  const std::array<Pose, 2> base{Pose{}, X_AB};  // in A
  std::array<SimulatedArm, 2> arms{SimulatedArm(parameters, gravity_A, kPeriod),
                                   SimulatedArm(parameters, X_AB.q.conjugate() * gravity_A, kPeriod)};
  const auto tip_at = [&](std::size_t i, double time) { return tipOf(base[i].inverseTimes(path.at(time)), link); };
  for (std::size_t i = 0; i < 2; ++i) {
    arms[i].encoders().setZero(zero_errors[i]);
    arms[i].place(tip_at(i, 0));
  }
  std::vector<LinkedSample> samples;
  const int ticks = static_cast<int>(std::lround(path.duration / kPeriod));
  for (int tick = 1; tick <= ticks; ++tick) {
    const double time = tick * kPeriod;
    for (std::size_t i = 0; i < 2; ++i) {
      const Vec3 target = tip_at(i, time), before = tip_at(i, time - kPeriod);
      arms[i].command(Vec3::Zero());
      arms[i].advance({.mass = kMass,
                       .stiffness = kStiffness,
                       .damping = kDamping,
                       .target = target,
                       .target_velocity = (target - before) / kPeriod});
    }
    if (time < kSettle || tick % kTicksPerSample != 0) continue;
    samples.push_back({linkCentre(arms[0].reportedPosition(), link), linkCentre(arms[1].reportedPosition(), link)});
  }
  return samples;
}

}  // namespace presa::percro
