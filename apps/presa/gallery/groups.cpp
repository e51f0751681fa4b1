#include "apps/presa/gallery/groups.h"

#include <algorithm>
#include <cctype>

namespace presa::gallery {

const std::vector<Group>& groups() {
  static const std::vector<Group> kGroups{{"contact", "Contact"},
                                          {"friction", "Friction"},
                                          {"grasp", "Grasp"},
                                          {"joints", "Things with joints"},
                                          {"piles", "Towers and piles"},
                                          {"effects", "Fields and textures"},
                                          {"tools", "Tools with volume"},
                                          {"psychophysics", "Psychophysics"},
                                          {"accuracy", "Accuracy"},
                                          {"methods", "Other methods of rendering"},
                                          {"percro", "The PERCRO system"}};
  return kGroups;
}

std::string titleOf(const std::string& group) {
  const auto found = std::ranges::find(groups(), group, &Group::name);
  if (found != groups().end()) return found->title;
  std::string title = group.empty() ? "others" : group;
  title.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(title.front())));
  return title;
}

}  // namespace presa::gallery
