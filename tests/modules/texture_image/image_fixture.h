#pragma once
#include <png.h>

#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/apps/support/support.h"
#include "tests/modules/texture/texture_fixture.h"

namespace presa::test {

/// Writes a PNG file by libpng's simplified interface, or its low one for 16 bits. `value`: from 0 to 1, of column and
/// row from the top.
inline std::string pngOf(const std::string& name, unsigned width, unsigned height, int bits,
                         const std::function<double(unsigned, unsigned)>& value, int type = PNG_COLOR_TYPE_GRAY) {
  const std::string file = scratch(name);
  std::FILE* const out = std::fopen(file.c_str(), "wb");
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  if (out == nullptr || info == nullptr) throw std::runtime_error("cannot write " + file);
  const unsigned channels = type == PNG_COLOR_TYPE_RGB ? 3 : type == PNG_COLOR_TYPE_GRAY_ALPHA ? 2 : 1;
  png_init_io(png, out);
  png_set_IHDR(png, info, width, height, bits, type, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  for (unsigned y = 0; y < height; ++y) {
    std::vector<png_byte> row;
    for (unsigned x = 0; x < width; ++x) {
      for (unsigned c = 0; c < channels; ++c) {
        const auto sample = static_cast<unsigned>(std::lround(value(x, y) * ((1U << bits) - 1)));
        if (bits == 16) row.push_back(static_cast<png_byte>(sample >> 8U));
        row.push_back(static_cast<png_byte>(sample & 0xffU));
      }
    }
    png_write_row(png, row.data());
  }
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  std::fclose(out);
  return file;
}

struct ImageValues {
  std::string file;
  double width = 2e-3, height = 0, amplitude = 1e-4;
};

/// The cube of the texture tests with an image in place of its texture.
inline World imageCube(const ImageValues& values, const Pose& X_WB = oddPose()) {
  World world = texturedCube({}, X_WB);
  PluginElement& element = world.scene.plugin_elements[0];
  const auto text = [](double number) {
    std::ostringstream out;
    out.precision(17);
    out << number;
    return out.str();
  };
  element.plugin = element.element = "texture_image";
  element.attributes = {{"file", values.file},
                        {"width", text(values.width)},
                        {"height", text(values.height)},
                        {"amplitude", text(values.amplitude)}};
  return world;
}

inline constexpr double kPlace = 1e-6 * kR;  // of the proxy, which ends within that of its place [m]

/// Work on a finger that goes once around a circle of 25 mm, by the trapezoidal rule [N m]. The circle `leaves` the face
/// and comes back, or stays below it.
struct Work {
  double net = 0, moved = 0;  ///< sum, and sum of the amounts
};
inline Work workRound(OnSide& finger, bool leaves, int steps) {
  Work sum;
  Vec3 last_p, last_f;
  for (int i = 0; i <= steps; ++i) {
    const double angle = kTurn * (i % steps) / steps;
    const double depth = leaves ? 0.00025 + 0.00075 * std::sin(angle + 0.3) : 0.0015 + 0.0005 * std::sin(2 * angle);
    const Vec3 p(0.004 * std::cos(angle), 0.004 * std::sin(angle), depth), f = finger.force(p.x(), p.y(), p.z());
    if (i > 0) {
      const Vec3 way = p - last_p;
      const double work = 0.5 * (f + last_f).dot(Vec3(way.x(), way.y(), -way.z()));
      sum.net += work;
      sum.moved += std::abs(work);
    }
    last_p = p;
    last_f = f;
  }
  return sum;
}

}  // namespace presa::test
