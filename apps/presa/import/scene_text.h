#pragma once
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "apps/robot_reader/robot.h"
#include "framework/core/diagnostics/diagnostics.h"

namespace presa::robot {

struct SceneSettings {
  std::string name;                       ///< of the scene and of its files
  std::string source;                     ///< file that the robot was read from, for the description
  std::string root;                       ///< link that is fixed to the world; empty: none
  std::map<std::string, double> carried;  ///< share of a link's weight that something else carries, by its name
  std::function<SourceLocation(const std::string&)> where;  ///< of a link in the source
  double stiffness = 1000;                                  ///< of all surfaces under a finger [N/m]
};

/// A scene, its rig and its meshes, and what of the robot is not in them.
struct SceneFiles {
  std::string scene;                          ///< text of NAME.xml
  std::map<std::string, std::string> others;  ///< name below the scene's folder -> text
  std::vector<std::string> notes;             ///< a sentence each
};

/// The robot as a scene: a body for each link, joints between them, and two fingers that mouse and keys move. Fingers feel
/// what collides, as one mesh where a link has several solids; bodies meet its solids, of meshes the convex hulls, as in
/// MuJoCo. E133: joints of one link that no joint of Presa has. Thread: main.
SceneFiles sceneOf(const Robot& robot, const SceneSettings& settings, Diagnostics& diagnostics);

}  // namespace presa::robot
