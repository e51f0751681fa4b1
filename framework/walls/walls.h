#pragma once
#include <string>
#include <vector>

#include "framework/core/diagnostics/diagnostics.h"
#include "framework/core/math/spatial.h"

/// The walls of a CAVE. Frame K: that of the walls' file, in which the head is tracked; SI units.
namespace presa::walls {

/// A rectangle on which a projector shows a picture; the fourth corner follows from the three.
struct Wall {
  std::string name;
  Vec3 lower_left = Vec3::Zero(), lower_right = Vec3::Zero(),
       upper_left = Vec3::Zero();  ///< corners in K, seen from the head [m]
  int width = 0, height = 0;       ///< [pixel], even
  SourceLocation where;
};

struct Walls {
  std::string name;
  double magnification = 1;     ///< size of the scene in K relative to its own
  Pose X_WK;                    ///< K's origin in the scene
  double eye_distance = 0.064;  ///< [m]
  Pose X_KHead;                 ///< of a head that nobody tracks: x to its right, y forward, z up
  std::vector<Wall> walls;
  std::string file;

  /// The wall of that name. Throws InputError E764.
  const Wall& wall(const std::string& wanted) const;
};

/// Reads a file of walls. All findings go to `diagnostics`; the result is valid only without errors: E760 a wall
/// without area, E761 one that is no rectangle, E762 an eye behind it, E763 a name that is used twice, E765 version.
Walls loadWalls(const std::string& file, Diagnostics& diagnostics);
/// As loadWalls, from memory.
Walls parseWalls(const std::string& xml, const std::string& name, Diagnostics& diagnostics);

}  // namespace presa::walls
