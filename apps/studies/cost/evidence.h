#pragma once
#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "framework/core/math/spatial.h"

namespace presa::cost {

/// What a finger and a free body did at one instant of the common grid, as plain numbers.
struct FingerSample {
  double touching = 0;  ///< 1 or 0
  double normal_force = 0;
  double force[3] = {0, 0, 0};  ///< that the device was sent, W [N]
  double proxy[3] = {0, 0, 0};  ///< W [m]
};
struct BodySample {
  double p[3] = {0, 0, 0};
  double q[4] = {1, 0, 0, 0};  ///< w x y z
};

/// One run on a grid of instants that all settings share: whole milliseconds.
struct Trace {
  std::size_t fingers = 0, bodies = 0;
  std::vector<std::int64_t> time_ns;
  std::vector<std::uint8_t> stepped;  ///< 1 where bodies are where a dynamics step put them, not in between
  std::vector<FingerSample> finger;   ///< fingers per instant
  std::vector<BodySample> body;       ///< free bodies per instant

  // What the devices hold from each haptic tick to the next, at the run's own rate.
  std::vector<std::int64_t> held_from_ns;
  std::vector<std::array<float, 3>> held;  ///< fingers per tick, W [N]

  /// Of the stored bytes: part of what decides whether a kept run serves.
  static constexpr const char* kFormat = "PRCOST03";
  void save(const std::string& file) const;
  static Trace load(const std::string& file);  ///< throws std::runtime_error
};

/// What one run showed about accuracy, beside its trace.
struct Evidence {
  std::string failure;                                 ///< why it cannot be compared; empty: it can
  double compared_from = 0, compared_to = 0;           ///< [s]
  double steady_from = 0, steady_to = 0;               ///< [s]
  std::optional<double> slip_force, slip_time;         ///< first slip after letting go began: mean over fingers [N, s]
  std::optional<double> energy_created, energy_drift;  ///< [J]
  std::optional<double> force_step;                    ///< at dynamics boundaries, RMS [N]
  std::optional<double> hum;                           ///< at the dynamics rate, amplitude [N]
  std::optional<double> penetration, penetration_max;  ///< of boxes: mean at rest, deepest ever [m]
  std::optional<double> rest_energy, rest_drift;       ///< of all free bodies [J], of the one that moves farthest [m]
  double seconds = 0;                                  ///< that the run took, watched
  std::uint64_t hash = 0;
  Trace trace;
};

nlohmann::json toJson(const Evidence& evidence);
Evidence evidenceFrom(const nlohmann::json& json);  ///< without the trace

/// What one run cost. Times are processor time of the thread.
struct Timing {
  struct Group {
    std::string name;
    double period = 0;  ///< [s]
    std::uint64_t ticks = 0;
    double mean = 0, median = 0, p999 = 0;  ///< per tick [s], the clock's own cost taken off
  };
  std::vector<std::string> engines;  ///< with versions
  double per_second = 0;             ///< all groups, seconds of processor per simulated second
  std::vector<Group> groups;
  double load = 0;          ///< from files to the first tick [s]
  double memory = 0;        ///< growth of the process [B]
  double instructions = 0;  ///< per simulated second; 0: not counted
};

nlohmann::json toJson(const Timing& timing);
Timing timingFrom(const nlohmann::json& json);

}  // namespace presa::cost
