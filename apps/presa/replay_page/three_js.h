#pragma once
#include <string>

namespace presa::replay_page {

/// three.js and its OrbitControls, as scripts of a page; from javascript/three in the folders of XDG_DATA_DIRS
/// (Debian's libjs-three). Throws InputError E127 when it is missing. Thread: main.
std::string threeJs();

}  // namespace presa::replay_page
