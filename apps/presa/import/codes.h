#pragma once

namespace presa::robot {

enum RobotCode {
  kTarget = 129,       ///< the output folder is not empty, or a file; or the scene would replace its own source
  kNeither = 130,      ///< neither URDF nor MJCF
  kUnreadable = 131,   ///< MuJoCo cannot read the model
  kNoFile = 132,       ///< a file that the model names is not there
  kNoSuchJoint = 133,  ///< joints of one link that no joint of Presa has
};

}  // namespace presa::robot
