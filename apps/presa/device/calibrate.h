#pragma once
#include <cstdint>
#include <optional>
#include <string>

namespace presa::device {

struct CalibrateOptions {
  std::string rig;         ///< two devices with pos and quat: about where they stand
  std::string samples;     ///< CSV of a linked motion; empty: a rehearsal
  std::uint64_t seed = 1;  ///< of a rehearsal
  double link = 0.03;      ///< from each reported position to the link's centre [m]
  std::string out;         ///< rig to write
};

/// `presa device calibrate`: finds where the second device stands from the first, and writes the rig that says so. A rehearsal
/// does it with modelled devices that stand elsewhere than the rig says, by an amount that the seed names, and tells
/// by how much it missed. Exit status 0 found, 1 the motion cannot tell (nothing is written). Throws InputError: E470 and E471
/// as `characterise`, E472 to E475, E476 the modelled devices cannot meet.
int calibrate(const CalibrateOptions& options);

}  // namespace presa::device
