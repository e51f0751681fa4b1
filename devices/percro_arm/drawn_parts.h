#pragma once
#include "devices/percro_arm/parameters.h"
#include "framework/device/device_figure.h"

namespace presa::percro {

/// Parts of the drawn arm, in the order of drawnParts(). Frames: D is that of kinematics.h; the barrel's has x along it.
enum DrawnPart {
  kBase,         ///< D
  kLeftPulley,   ///< driven by a capstan of the differential, turns about z of D; at z < 0
  kRightPulley,  ///< at z > 0
  kGimbal,       ///< D after the tilt
  kOuterTube,    ///< the barrel's, origin at the axes
  kDrum,         ///< of the barrel's motor, turns about the barrel's z; origin on its shaft
  kInnerTube,    ///< the barrel's, origin at the tip
  kFork,         ///< after the wrist's roll, origin at the tip
  kRing,         ///< after its pitch, origin at the tip
  kThimble,      ///< the thimble's, origin at the tip
  kDrawnParts
};

/// Shaft of the barrel's motor in the frame of the outer tube [m].
Vec3 drumShaft(const Parameters& parameters);

/// Shapes and colours. The paper shows the arm in figures 1, 4 and 7, without measures: lengths of the barrel, radii of
/// pulley and drum, and the lever of the counterweight are the model's, all else is a GUESS to look at.
std::vector<FigurePart> drawnParts(const Parameters& parameters);

}  // namespace presa::percro
