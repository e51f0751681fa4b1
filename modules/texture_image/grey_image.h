#pragma once
#include <string>
#include <vector>

namespace presa {

/// A grey image; rows from top to bottom.
struct GreyImage {
  int width = 0, height = 0;  ///< [pixels], > 0
  std::vector<float> value;   ///< from 0, black, to 1, white: the samples as stored, without a correction of gamma
};

inline constexpr int kMaxSide = 2048;  ///< of an image that is read [pixels]

/// Reads a grey PNG file of 1 to 16 bits. Throws std::invalid_argument, with the file's name: a file that cannot be
/// read or is no PNG, is damaged, has colours or transparency, or is larger than kMaxSide or 32 MB. Thread: main.
GreyImage readGreyPng(const std::string& file);

}  // namespace presa
