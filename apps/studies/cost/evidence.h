#pragma once
#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "framework/core/math/spatial.h"

namespace presa::cost {

/// State of a finger and of a free body at one instant of the common time grid, as plain numbers.
struct FingerSample {
  double touching = 0;  ///< 1 or 0
  double normal_force = 0;
  double force[3] = {0, 0, 0};  ///< commanded to the device, W [N]
  double proxy[3] = {0, 0, 0};  ///< position of the proxy, W [m]
};
struct BodySample {
  double p[3] = {0, 0, 0};
  double q[4] = {1, 0, 0, 0};  ///< w x y z
};

/// One run, sampled on a time grid shared by all settings: whole milliseconds.
struct Trace {
  std::size_t fingers = 0, bodies = 0;
  std::vector<std::int64_t> time_ns;
  std::vector<std::uint8_t> stepped;  ///< 1: at the end of a dynamics step; 0: body poses are interpolated
  std::vector<FingerSample> finger;   ///< `fingers` entries per instant
  std::vector<BodySample> body;       ///< `bodies` entries per instant, one per free body

  // The force that the devices hold from each haptic tick to the next, at the run's own rate.
  std::vector<std::int64_t> held_from_ns;
  std::vector<std::array<float, 3>> held;  ///< `fingers` entries per tick, W [N]

  /// Version of the file format; part of the hash that decides whether a stored run is reused.
  static constexpr const char* kFormat = "PRCOST03";
  void save(const std::string& file) const;
  static Trace load(const std::string& file);  ///< throws std::runtime_error
};

/// Accuracy figures of one run, with its trace.
struct Evidence {
  std::string failure;                                 ///< why the run cannot be compared; empty: it can
  double compared_from = 0, compared_to = 0;           ///< [s]
  double steady_from = 0, steady_to = 0;               ///< [s]
  std::optional<double> slip_force, slip_time;         ///< at the first slip while letting go: mean over fingers [N, s]
  std::optional<double> energy_created, energy_drift;  ///< [J]
  std::optional<double> force_step;                    ///< force step at dynamics boundaries, RMS [N]
  std::optional<double> hum;                           ///< force amplitude at the dynamics rate [N]
  std::optional<double> penetration, penetration_max;  ///< overlap of boxes: mean at rest, max [m]
  std::optional<double> rest_energy, rest_drift;       ///< of all free bodies [J]; of the farthest one [m]
  double seconds = 0;                                  ///< wall time of the watched run [s]
  std::uint64_t hash = 0;
  Trace trace;
};

nlohmann::json toJson(const Evidence& evidence);
Evidence evidenceFrom(const nlohmann::json& json);  ///< without the trace

/// Cost of one run. Times are processor time of the thread.
struct Timing {
  struct Group {
    std::string name;
    double period = 0;  ///< [s]
    std::uint64_t ticks = 0;
    double mean = 0, median = 0, p999 = 0;  ///< per tick [s], without the cost of reading the clock
  };
  std::vector<std::string> engines;  ///< with versions
  double per_second = 0;             ///< processor time of all groups per simulated second [-]
  std::vector<Group> groups;
  double load = 0;          ///< from reading the files to the first tick [s]
  double memory = 0;        ///< growth of the process [B]
  double instructions = 0;  ///< per simulated second; 0: not counted
};

nlohmann::json toJson(const Timing& timing);
Timing timingFrom(const nlohmann::json& json);

}  // namespace presa::cost
