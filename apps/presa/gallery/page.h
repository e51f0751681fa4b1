#pragma once
#include <string>
#include <vector>

#include "apps/presa/gallery/entries.h"

namespace presa::gallery {

/// The gallery as one HTML file for any browser, offline, with the stored pictures in it.
std::string page(const std::vector<Entry>& entries);

}  // namespace presa::gallery
