#pragma once
#include <optional>
#include <string>
#include <vector>

#include "apps/robot_reader/robot.h"

namespace presa::robot {

/// The joint of a link that hangs on its parent.
struct JointText {
  std::string text;                ///< the element `<joint>`; empty: the link moves freely
  std::vector<std::string> notes;  ///< what is not in it, a sentence each
};

/// None: no joint of Presa has these freedoms. `to`: the parent's body, empty for the world.
std::optional<JointText> jointOf(const Link& link, const std::string& name, const std::string& body,
                                 const std::string& to);

}  // namespace presa::robot
