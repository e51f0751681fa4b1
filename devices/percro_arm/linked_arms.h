#pragma once
#include <array>
#include <vector>

#include "devices/percro_arm/simulated_arm.h"
#include "devices/percro_arm/calibration/linked_bases.h"
#include "framework/core/math/random.h"

/// The second calibration of [Bergamasco2006 2.2], on modelled arms: thimbles clamped in line with the barrels, a Cardan joint
/// between them; one arm is led along a path, the other follows without resistance. Thread: any; takes seconds.
namespace presa::percro {

/// A smooth way of the Cardan's centre: sums of slow sines about a middle, in A.
struct LinkPath {
  Vec3 middle{0.75, 0, 0};
  Vec3 amplitude{0.08, 0.08, 0.08};  ///< along D's axes [m]
  Vec3 rate{0.31, 0.23, 0.17};       ///< [Hz]
  Vec3 phase = Vec3::Zero();         ///< [rad]
  double duration = 20;              ///< [s]
  Vec3 at(double time) const;
};
/// Another one for each seed, of about this size.
LinkPath randomPath(RandomStream& stream, double size);

/// Centre of the Cardan from a tip: `link` beyond it on the barrel's line [m].
Vec3 linkCentre(const Vec3& p_DT, double link);
/// Where the tip is when the centre is there.
Vec3 tipOf(const Vec3& p_DC, double link);

/// Both arms reach the whole path, the second standing at X_AB.
bool meetAlong(const Geometry& geometry, const Pose& X_AB, const LinkPath& path, double link);

/// Every 10 ms what both arms' encoders say of the centre. The arms are the whole model: friction, weight, bending.
/// X_AB: how they really stand. `gravity_A`: acceleration in A [m/s^2]. `zero_errors`: what homing left, in counts.
std::vector<LinkedSample> moveLinked(const Parameters& parameters, const Vec3& gravity_A, const Pose& X_AB,
                                     const LinkPath& path, double link,
                                     const std::array<Vec3, 2>& zero_errors = {Vec3::Zero(), Vec3::Zero()});

}  // namespace presa::percro
