#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include "framework/core/math/spatial.h"
#include "framework/scene/xml/xml.h"

namespace presa::device {

/// Reads a rig of two devices with poses, and writes it again with another pose of the second device.
class RigBases {
 public:
  /// Throws InputError with the findings of the file, or E473 unless it has two devices of one driver with pos and
  /// quat.
  explicit RigBases(const std::string& file);

  const std::string& driver() const { return driver_; }
  const std::string& role(int device) const { return roles_[device]; }
  const Pose& base(int device) const { return bases_[device]; }  ///< X_WD

  /// XML of the rig with this pose of the second device, for a file in this folder: paths in it are made relative to
  /// it.
  std::string withSecondAt(const Pose& X_WB, const std::string& folder) const;
  /// The rig as it is, with absolute paths.
  const std::string& resolved() const { return resolved_; }
  /// XML of a rig of the same modelled devices, the second one at this pose, linked, and led by the hand linking_hand.
  std::string rehearsal(const Pose& X_WB, int leader, double link, std::uint64_t seed) const;

 private:
  std::string file_, driver_, roles_[2], resolved_;
  Pose bases_[2];
};

}  // namespace presa::device
