#pragma once
#include <vector>

namespace presa::replay_page {

struct File {
  const char* path;  ///< in the source tree
  const char* text;
};
/// Style sheet, markup and scripts of the page, in the order of the page. Embedded at build time.
const std::vector<File>& files();

}  // namespace presa::replay_page
