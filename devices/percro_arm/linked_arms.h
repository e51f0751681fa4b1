#pragma once
#include <array>
#include <vector>

#include "devices/percro_arm/calibration/linked_bases.h"
#include "devices/percro_arm/simulated_arm.h"
#include "framework/core/math/random.h"

/// The second calibration of [Bergamasco2006 2.2] on modelled arms: the thimbles are clamped in line with the barrels
/// and linked by a Cardan joint; one arm is led along a path, the other follows freely. Thread: any; takes seconds.
namespace presa::percro {

/// A smooth path of the Cardan joint's centre, in A: slow sines about a middle.
struct LinkPath {
  Vec3 middle{0.75, 0, 0};
  Vec3 amplitude{0.08, 0.08, 0.08};  ///< along D's axes [m]
  Vec3 rate{0.31, 0.23, 0.17};       ///< [Hz]
  Vec3 phase = Vec3::Zero();         ///< [rad]
  double duration = 20;              ///< [s]
  Vec3 at(double time) const;
};
/// A random path of about this size [m].
LinkPath randomPath(RandomStream& stream, double size);

/// Centre of the Cardan joint for a tip position: `link` [m] beyond the tip on the barrel's axis.
Vec3 linkCentre(const Vec3& p_DT, double link);
/// Tip position for a centre of the Cardan joint.
Vec3 tipOf(const Vec3& p_DC, double link);

/// True when both arms reach the whole path, with the second base at X_AB.
bool meetAlong(const Geometry& geometry, const Pose& X_AB, const LinkPath& path, double link);

/// Centre of the joint by both arms' encoders, every 10 ms. The arms are the full model: friction, weight, compliance.
/// X_AB: the true pose of base B. `gravity_A`: acceleration in A [m/s^2]. `zero_errors`: errors of the homing, in
/// counts.
std::vector<LinkedSample> moveLinked(const Parameters& parameters, const Vec3& gravity_A, const Pose& X_AB,
                                     const LinkPath& path, double link,
                                     const std::array<Vec3, 2>& zero_errors = {Vec3::Zero(), Vec3::Zero()});

}  // namespace presa::percro
