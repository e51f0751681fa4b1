#pragma once
#include <cstdint>
#include <optional>
#include <string>

namespace presa::device {

struct CalibrateOptions {
  std::string rig;         ///< rig of two devices with pos and quat, their approximate poses
  std::string samples;     ///< CSV of a linked motion; empty: a rehearsal
  std::uint64_t seed = 1;  ///< random seed of a rehearsal
  double link = 0.03;      ///< from each reported position to the link's centre [m]
  std::string out;         ///< rig to write
};

/// `presa device calibrate`: finds the pose of the second device relative to the first, and writes a rig with it. A
/// rehearsal uses modelled devices whose poses differ from the rig's by a random amount (`seed`), and reports the error
/// of the result. Exit status 0: found; 1: the motion does not determine the pose (nothing is written). Throws
/// InputError: E470 and E471 as `characterise`, E472 to E475, E476 the modelled devices cannot meet.
int calibrate(const CalibrateOptions& options);

}  // namespace presa::device
