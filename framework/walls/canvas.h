#pragma once
#include <array>
#include <string_view>

#include "framework/walls/projection.h"

namespace presa::walls {

/// How a wall shows the pictures of both eyes.
enum class Stereo : std::size_t {
  kMono,        ///< one picture, from between the eyes
  kSideBySide,  ///< left eye in the left half, each half of the width
  kTopBottom,   ///< left eye in the upper half, each half of the height
  kAnaglyph,    ///< red for the left eye, green and blue for the right one
  kQuad         ///< left and right buffers of the driver
};
inline constexpr std::array<std::string_view, 5> kStereoNames{"mono", "side_by_side", "top_bottom", "anaglyph", "quad"};

/// A wall as a view draws it: written by the module that knows the head, before the view's step, on its thread.
struct Canvas {
  int width = 0, height = 0;  ///< of the wall [pixel]
  Stereo stereo = Stereo::kMono;
  std::array<Frustum, 2> eyes;  ///< left, right; mono: the first
  bool quad_refused = false;    ///< answer of the view: the driver has no such buffers, so it draws mono
};

}  // namespace presa::walls
