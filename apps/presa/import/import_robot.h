#pragma once
#include <optional>
#include <string>

#include "apps/presa/import/scene_text.h"
#include "apps/presa/import/source.h"

namespace presa::robot {

struct Wanted {
  std::string file, folder;  ///< what is read, and where the scene goes
  double stiffness = 1000;   ///< of all surfaces under a finger [N/m]
  bool free_base = false;    ///< the root link of a URDF moves freely
  bool overwrite = false;
};

struct Imported {
  std::string name;  ///< of the scene, and of its file without ".xml"
  SceneFiles files;
  std::vector<LeftOut> left_out;
};

/// E129 if the folder is not empty, or is a file. Thread: main.
void checkTarget(const Wanted& wanted, Diagnostics& diagnostics);
/// Reads the robot; nothing is written but a scratch folder, which is removed. None: errors in `diagnostics`; those of
/// prepare and sceneOf, and E131: MuJoCo cannot read the model. Thread: main.
std::optional<Imported> importRobot(const Wanted& wanted, Diagnostics& diagnostics);
/// Writes all files into the folder, the scene last, and returns its path. Throws std::system_error.
std::string write(const std::string& folder, const Imported& imported);
/// What the scene has not, for people: a line each.
std::string leftOutText(const Imported& imported);

}  // namespace presa::robot
