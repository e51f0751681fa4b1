#pragma once
#include <cstdint>
#include <optional>
#include <string>

namespace presa::device {

struct CalibrateOptions {
  std::string rig;         ///< rig of two devices with pos and quat, their approximate poses
  std::string samples;     ///< CSV of a linked motion; empty: it is recorded or rehearsed
  std::string record;      ///< CSV to write: the motion is recorded now, in both directions
  double seconds = 20;     ///< of each direction of a recording
  bool rehearsal = false;  ///< with `record`: on modelled devices that a simulated hand leads
  std::uint64_t seed = 1;  ///< random seed of a rehearsal
  double link = 0.03;      ///< from each reported position to the link's centre [m]
  std::string out;         ///< rig to write
};

/// `presa device calibrate`: finds the pose of the second device relative to the first, and writes a rig with it. A
/// rehearsal uses modelled devices whose poses differ from the rig's by a random amount (`seed`), and reports the error
/// of the result. A recording leads the user: one device is led by the other, then the other way round; a rehearsal of
/// it runs through the same devices, executor and output stage. Exit status 0: found; 1: the motion does not determine the pose (no rig is written). Throws
/// InputError: E470 and E471 as `characterise`, E472 to E475, E476 the modelled devices cannot meet, E400 no samples.
int calibrate(const CalibrateOptions& options);

}  // namespace presa::device
