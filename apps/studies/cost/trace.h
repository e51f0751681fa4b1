#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// What metrics read of a run.
namespace presa::cost {

/// State of a finger and of a free body at one instant of the common time grid, as plain numbers.
struct FingerSample {
  double touching = 0;           ///< 1 or 0
  double normal_force = 0;       ///< >= 0 [N]
  double force[3] = {0, 0, 0};   ///< commanded to the device, W [N]
  double proxy[3] = {0, 0, 0};   ///< position of the proxy, W [m]
  double torque[3] = {0, 0, 0};  ///< commanded to the device, about the finger, W [N m]
  double stretch = 0;            ///< distance from finger to proxy [m]
  double traction = 0;           ///< tangential over normal force of the contact [-]
  double slipping = 0;           ///< 1 or 0
};
/// Pose X_WB of a free body at such an instant.
struct BodySample {
  double p[3] = {0, 0, 0};     ///< position, W [m]
  double q[4] = {1, 0, 0, 0};  ///< w x y z
};

/// One run, sampled on a time grid shared by all settings: whole milliseconds.
struct Trace {
  std::size_t fingers = 0,            ///< of the scene
      bodies = 0;                     ///< free ones
  std::vector<std::int64_t> time_ns;  ///< the instants [ns]
  std::vector<std::uint8_t> stepped;  ///< 1: at the end of a dynamics step; 0: body poses are interpolated
  std::vector<FingerSample> finger;   ///< `fingers` entries per instant
  std::vector<BodySample> body;       ///< `bodies` entries per instant, one per free body

  // The force that the devices hold from each haptic tick to the next, at the run's own rate.
  std::vector<std::int64_t> held_from_ns;  ///< the haptic ticks [ns]
  std::vector<std::array<float, 3>> held;  ///< `fingers` entries per tick, W [N]

  /// Version of the file format; part of the hash that decides whether a stored run is reused.
  static constexpr const char* kFormat = "PRCOST05";
  void save(const std::string& file) const;    ///< throws when the file cannot be written
  static Trace load(const std::string& file);  ///< throws std::runtime_error
};

/// Accuracy figures of one run, with its trace.
struct Evidence {
  std::string failure;                   ///< why the run cannot be compared; empty: it can
  double compared_from = 0,              ///< start of the window of errors [s]
      compared_to = 0;                   ///< its end [s]
  double steady_from = 0,                ///< start of the window of mean values [s]
      steady_to = 0;                     ///< its end [s]
  std::optional<double> slip_force,      ///< normal force at the first slip while letting go: mean over fingers [N]
      slip_time;                         ///< when that was: mean over fingers [s]
  std::optional<double> energy_created,  ///< largest rise of energy minus work of the hands [J]
      energy_drift;                      ///< largest change of the energy, of scenes without fingers [J]
  std::optional<double> force_step;      ///< force step at dynamics boundaries, RMS [N]
  std::optional<double> hum;             ///< force amplitude at the dynamics rate [N]
  std::vector<double> vibration;         ///< by finger: RMS of the held force from 40 to 400 Hz [N]; empty: unknown
  std::optional<double> penetration,     ///< overlap of boxes, mean over the steady window [m]
      penetration_max;                   ///< deepest overlap of boxes [m]
  std::optional<double> rest_energy,     ///< kinetic, of all free bodies, mean over the steady window [J]
      rest_drift;                        ///< of the body that moves farthest in the steady window [m]
  double seconds = 0;                    ///< wall time of the watched run [s]
  std::uint64_t hash = 0;                ///< state hash of the run: equal runs have equal hashes
  Trace trace;                           ///< samples of the run
  std::optional<double> joint_gap,       ///< opening of the widest joint [m]
      joint_tilt;                        ///< opening of the widest joint [rad]
};

}  // namespace presa::cost
