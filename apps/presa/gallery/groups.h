#pragma once
#include <string>
#include <vector>

namespace presa::gallery {

/// What several scenes teach. A scene names its group: <scene group="grasp">.
struct Group {
  std::string name, title;
};

/// In the order in which they are shown.
const std::vector<Group>& groups();
/// Title of a group; of one that is not listed: its name, with a capital.
std::string titleOf(const std::string& group);

}  // namespace presa::gallery
