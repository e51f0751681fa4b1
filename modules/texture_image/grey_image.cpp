// libpng reports errors by a jump to setjmp. What the jump would skip has no destructor: objects live in the caller.
#include "modules/texture_image/grey_image.h"

#include <png.h>

#include <csetjmp>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <stdexcept>

#include "framework/input/input.h"

namespace presa {
namespace {

constexpr std::uint64_t kMaxBytes = std::uint64_t{32} << 20U;

/// What the reader has and gives.
struct Reading {
  const std::string& bytes;
  std::size_t at = 0;
  char problem[160] = {};
  png_uint_32 width = 0, height = 0;
  int depth = 0;                       // bits of a sample that is handed over: 8 or 16
  std::vector<png_byte> samples = {};  // 16 bits: high byte first
  std::vector<png_bytep> rows = {};
};

void say(Reading& reading, const char* problem) { std::strncpy(reading.problem, problem, sizeof reading.problem - 1); }

[[noreturn]] void fail(png_structp png, png_const_charp message) {
  auto& reading = *static_cast<Reading*>(png_get_error_ptr(png));
  std::snprintf(reading.problem, sizeof reading.problem, "is damaged: %s", message);
  png_longjmp(png, 1);
}

void ignore(png_structp, png_const_charp) {}

void give(png_structp png, png_bytep to, png_size_t count) {
  auto& reading = *static_cast<Reading*>(png_get_io_ptr(png));
  if (count > reading.bytes.size() - reading.at) png_error(png, "it ends too early");
  std::memcpy(to, reading.bytes.data() + reading.at, count);
  reading.at += count;
}

/// Refuses what is no height map, before any memory is taken for it.
bool suits(png_structp png, png_infop info, Reading& reading) {
  reading.width = png_get_image_width(png, info);
  reading.height = png_get_image_height(png, info);
  if (reading.width > static_cast<png_uint_32>(kMaxSide) || reading.height > static_cast<png_uint_32>(kMaxSide)) {
    std::snprintf(reading.problem, sizeof reading.problem, "has %u by %u pixels, at most %d by %d are read",
                  reading.width, reading.height, kMaxSide, kMaxSide);
    return false;
  }
  const int type = png_get_color_type(png, info);
  if (type == PNG_COLOR_TYPE_GRAY) return true;
  say(reading, type == PNG_COLOR_TYPE_GRAY_ALPHA ? "has transparency; only grey images are read"
                                                 : "has colours; only grey images are read");
  return false;
}

/// The size, and how rows will be handed over. False: see the problem.
bool readHead(png_structp png, png_infop info, Reading& reading) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;    // NOLINT(cert-err52-cpp): the interface of libpng
  png_set_user_limits(png, 0x7fffffff, 0x7fffffff);  // so that the size in the error is that of the file
  png_read_info(png, info);
  if (!suits(png, info, reading)) return false;
  reading.depth = png_get_bit_depth(png, info) == 16 ? 16 : 8;
  png_set_expand_gray_1_2_4_to_8(png);
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  return true;
}

bool readRows(png_structp png, Reading& reading) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;  // NOLINT(cert-err52-cpp)
  png_read_image(png, reading.rows.data());
  png_read_end(png, nullptr);
  return true;
}

bool readAll(Reading& reading) {
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &reading, fail, ignore);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  if (info == nullptr) {
    png_destroy_read_struct(&png, nullptr, nullptr);
    throw std::bad_alloc();
  }
  png_set_read_fn(png, &reading, give);
  bool read = readHead(png, info, reading);
  if (read) {
    const std::size_t row = reading.width * static_cast<std::size_t>(reading.depth / 8);
    reading.samples.resize(row * reading.height);
    for (png_uint_32 y = 0; y < reading.height; ++y) reading.rows.push_back(reading.samples.data() + y * row);
    read = readRows(png, reading);
  }
  png_destroy_read_struct(&png, &info, nullptr);
  return read;
}

}  // namespace

GreyImage readGreyPng(const std::string& file) {
  const auto refuse = [&](const std::string& problem) {
    throw std::invalid_argument("image " + quote(file) + " " + problem);
  };
  input::Refusal refusal;
  const auto bytes = input::read(file, kMaxBytes, refusal);
  if (!bytes) refuse(refusal.what);
  constexpr std::size_t kSignature = 8;
  if (bytes->size() < kSignature ||
      png_sig_cmp(reinterpret_cast<png_const_bytep>(bytes->data()), 0, kSignature) != 0)  // NOLINT
    refuse("is no PNG file");
  Reading reading{.bytes = *bytes};
  if (!readAll(reading)) refuse(reading.problem);
  GreyImage image{static_cast<int>(reading.width), static_cast<int>(reading.height), {}};
  const std::size_t count = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  image.value.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const int sample =
        reading.depth == 16 ? 256 * reading.samples[2 * i] + reading.samples[2 * i + 1] : 257 * reading.samples[i];
    image.value.push_back(static_cast<float>(sample) / 65535.0F);
  }
  return image;
}

}  // namespace presa
