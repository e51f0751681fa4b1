#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "apps/presa/gallery/entries.h"

namespace presa::gallery {

/// The gallery for a terminal of so many columns: a heading for each group, a name and a sentence for each scene.
std::string listing(const std::vector<Entry>& entries, std::size_t columns, bool color);

}  // namespace presa::gallery
