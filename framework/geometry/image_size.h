#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace presa {

/// What the head of a compressed picture says. Nothing is decoded.
struct ImageSize {
  /// By the first bytes, not by the name of the file.
  enum class Format { kPng, kJpeg };
  Format format = Format::kPng;  ///< decides how a viewer decodes it
  std::uint32_t width = 0,       ///< [pixel]
      height = 0;                ///< [pixel]
};

/// From the first bytes of a PNG or a JPEG file; none: it is neither, or damaged. Sources: [ISO 15948 11.2.2],
/// [ITU-T T.81 B.2.2]. Thread: any.
std::optional<ImageSize> imageSize(std::string_view bytes);

}  // namespace presa
