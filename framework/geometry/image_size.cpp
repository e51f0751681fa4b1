#include "framework/geometry/image_size.h"

#include <cstddef>

namespace presa {
namespace {

using namespace std::string_view_literals;

/// A big-endian number of `count` bytes.
std::uint32_t number(std::string_view bytes, std::size_t at, std::size_t count) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < count; ++i) value = value << 8U | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

/// The signature, then the chunk IHDR, which comes first.
std::optional<ImageSize> sizeOfPng(std::string_view bytes) {
  constexpr std::size_t kHead = 24;
  if (bytes.size() < kHead || bytes.substr(12, 4) != "IHDR"sv) return std::nullopt;
  return ImageSize{ImageSize::Format::kPng, number(bytes, 16, 4), number(bytes, 20, 4)};
}

/// The first frame header (SOF0 to SOF15) after the segments before it.
std::optional<ImageSize> sizeOfJpeg(std::string_view bytes) {
  for (std::size_t at = 2; at + 9 <= bytes.size();) {
    if (bytes[at] != '\xff') return std::nullopt;
    const auto marker = static_cast<unsigned char>(bytes[at + 1]);
    if (marker == 0xff) {  // fill byte
      ++at;
      continue;
    }
    // without a length, and in no head before the frame: a decoder would look behind them for another frame
    if (marker <= 0x01 || (marker >= 0xd0 && marker <= 0xda)) return std::nullopt;
    const bool frame = marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
    if (frame) return ImageSize{ImageSize::Format::kJpeg, number(bytes, at + 7, 2), number(bytes, at + 5, 2)};
    const std::uint32_t length = number(bytes, at + 2, 2);
    if (length < 2) return std::nullopt;
    at += 2 + length;
  }
  return std::nullopt;
}

}  // namespace

std::optional<ImageSize> imageSize(std::string_view bytes) {
  std::optional<ImageSize> size;
  if (bytes.starts_with("\x89PNG\r\n\x1a\n"sv)) size = sizeOfPng(bytes);
  if (bytes.starts_with("\xff\xd8\xff"sv)) size = sizeOfJpeg(bytes);
  return size && size->width > 0 && size->height > 0 ? size : std::nullopt;
}

}  // namespace presa
