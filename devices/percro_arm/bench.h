#pragma once
#include <vector>

#include "devices/percro_arm/simulated_arm.h"

/// The experiments of [Bergamasco2006 2.1.2] on the modelled arm: the tip is bolted to the ground through a force
/// sensor, the motors are commanded at 1 kHz, the joints are measured by the encoders. Thread: any; takes seconds.
namespace presa::percro {

struct ForceResponse {
  std::vector<double> frequency, gain_db;  ///< [Hz]; sensor force over commanded force [dB]
  double bandwidth = 0;                    ///< first frequency 3 dB below the lowest one's gain [Hz]; 0: none
  double resonance = 0, peak_db = 0;       ///< frequency [Hz] and value [dB] of the max gain
};
/// Force response along the barrel: a sine of 2 N about 3 N, one frequency after the other (the paper uses a chirp).
ForceResponse forceResponse(const Parameters& parameters, const std::vector<double>& frequencies);
/// Reference for forceResponse() [dB]: the linear model, without dry friction, encoders and sampling.
double linearGain(const Parameters& parameters, double frequency);

/// A ramp of force up and down, with the displacement measured by the encoders.
struct Push {
  std::vector<double> displacement, force;  ///< [m]; [N] at the sensor
  double stiffness = 0;                     ///< least squares of force over displacement [N/m]
  double r_squared = 0;
};
/// `direction`: in D, unit length.
Push push(const Parameters& parameters, double length, const Vec3& direction, double max_force);

/// A hand (0.1 kg, 300 N/m) leans with 3 N on a virtual wall of this stiffness [N/m], rendered from the encoders at 1
/// kHz. Returns the peak-to-peak motion of the tip after 3 s [m]; 0: the wall is steady.
double wallShake(const Parameters& parameters, double length, const Vec3& direction, double stiffness,
                 double hand_damping);

}  // namespace presa::percro
