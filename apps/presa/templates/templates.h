#pragma once
#include <vector>

namespace presa::templates {

struct File {
  const char* path;  ///< in the source tree
  const char* text;
};
/// The files of apps/presa/templates, and those of config that a new project starts with. Embedded at build time.
const std::vector<File>& files();

}  // namespace presa::templates
