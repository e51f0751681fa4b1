#pragma once
#include <vector>

#include "devices/percro_arm/simulated_arm.h"

/// The experiments of [Bergamasco2006 2.1.2], on the modelled arm: its tip bolted to the ground through a force sensor, its
/// motors commanded at 1 kHz, its joints known by their encoders. Thread: any; takes seconds.
namespace presa::percro {

struct ForceResponse {
  std::vector<double> frequency, gain_db;  ///< [Hz], of the sensor's force over the commanded one
  double bandwidth = 0;                    ///< first frequency 3 dB below the slowest [Hz]; 0: none
  double resonance = 0, peak_db = 0;       ///< where the gain is largest
};
/// Along the barrel: 2 N about 3 N, frequency after frequency (the paper: a chirp).
ForceResponse forceResponse(const Parameters& parameters, const std::vector<double>& frequencies);
/// The same of the linear model, without dry friction, encoders and ticks: an oracle, in dB.
double linearGain(const Parameters& parameters, double frequency);

/// A ramp of force up and down, and the displacement that the encoders tell.
struct Push {
  std::vector<double> displacement, force;  ///< [m], [N] at the sensor
  double stiffness = 0;                     ///< least squares of force over displacement [N/m]
  double r_squared = 0;
};
/// `direction`: in D, unit length.
Push push(const Parameters& parameters, double length, const Vec3& direction, double most_force);

/// A hand (0.1 kg, 300 N/m) leans with 3 N on a virtual wall of this stiffness, rendered from the encoders at 1 kHz: by how
/// much the tip still moves to and fro after 3 s [m]. 0: the wall stands.
double wallShake(const Parameters& parameters, double length, const Vec3& direction, double stiffness,
                 double hand_damping);

}  // namespace presa::percro
