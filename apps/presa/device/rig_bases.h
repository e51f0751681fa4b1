#pragma once
#include <memory>
#include <string>

#include "framework/core/math/spatial.h"
#include "framework/scene/xml/xml.h"

namespace presa::device {

/// A rig of two devices that stand somewhere: read, and written again with the second moved.
class RigBases {
 public:
  /// Throws InputError: what is wrong with the file, and E473 when it has not two devices of one driver with pos and quat.
  explicit RigBases(const std::string& file);

  const std::string& driver() const { return driver_; }
  const std::string& role(int device) const { return roles_[device]; }
  const Pose& base(int device) const { return bases_[device]; }  ///< X_WD

  /// The rig with the second device's base there, for a file in that folder: the files it names are told from there.
  std::string withSecondAt(const Pose& X_WB, const std::string& folder) const;

 private:
  std::string file_, driver_, roles_[2];
  Pose bases_[2];
};

}  // namespace presa::device
