#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

/// Model files that tests write: pictures, and meshes with colours.
namespace presa::test {

using Rgb = std::array<std::uint8_t, 3>;

inline std::string bigEndian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xffU);
  return bytes;
}

inline std::string pngChunk(const std::string& kind, const std::string& data) {
  const std::string body = kind + data;
  std::uint32_t sum = ~0U;  // CRC-32 of ISO 3309
  for (const char c : body) {
    sum ^= static_cast<std::uint8_t>(c);
    for (int bit = 0; bit < 8; ++bit) sum = sum >> 1U ^ (0xedb88320U & (0U - (sum & 1U)));
  }
  return bigEndian(static_cast<std::uint32_t>(data.size())) + body + bigEndian(~sum);
}

inline std::string pngHead(std::uint32_t width, std::uint32_t height) {
  return "\x89PNG\r\n\x1a\n" +
         pngChunk("IHDR", bigEndian(width) + bigEndian(height) + std::string("\x08\x02\0\0\0", 5));
}

/// A PNG of 8 bits; `pixel` gets the column and the row from above.
inline std::string png(std::uint32_t width, std::uint32_t height,
                       const std::function<Rgb(std::uint32_t, std::uint32_t)>& pixel) {
  std::string rows;
  for (std::uint32_t y = 0; y < height; ++y) {
    rows += '\0';
    for (std::uint32_t x = 0; x < width; ++x)
      for (const std::uint8_t c : pixel(x, y)) rows += static_cast<char>(c);
  }
  // zlib's format without compression: blocks of up to 64 KiB
  std::string packed = "\x78\x01";
  std::uint32_t a = 1, b = 0;
  for (std::size_t at = 0; at < rows.size(); at += 0xffff) {
    const std::size_t size = std::min<std::size_t>(0xffff, rows.size() - at);
    packed += at + size == rows.size() ? '\1' : '\0';
    for (const std::size_t word : {size, ~size}) packed += {static_cast<char>(word), static_cast<char>(word >> 8U)};
    packed += rows.substr(at, size);
  }
  for (const char c : rows) a = (a + static_cast<std::uint8_t>(c)) % 65521, b = (b + a) % 65521;
  packed += bigEndian(b << 16U | a);
  return pngHead(width, height) + pngChunk("IDAT", packed) + pngChunk("IEND", "");
}
inline std::string png(const Rgb& color) {
  return png(4, 4, [&](std::uint32_t, std::uint32_t) { return color; });
}

inline std::string written(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
  return file.string();
}

/// A grid of vertices with texture coordinates, v upwards; two triangles a cell, counter-clockwise from +n.
struct Sheet {
  std::vector<std::array<float, 3>> places, normals;
  std::vector<std::array<float, 2>> at;
  std::vector<std::uint32_t> corners;
};
/// `place` and `normal` of (u, v) in [0, 1]².
inline Sheet sheet(std::uint32_t columns, std::uint32_t rows,
                   const std::function<std::array<float, 3>(float, float)>& place,
                   const std::function<std::array<float, 3>(float, float)>& normal) {
  Sheet s;
  for (std::uint32_t j = 0; j <= rows; ++j) {
    for (std::uint32_t i = 0; i <= columns; ++i) {
      const float u = static_cast<float>(i) / static_cast<float>(columns),
                  v = static_cast<float>(j) / static_cast<float>(rows);
      s.places.push_back(place(u, v)), s.normals.push_back(normal(u, v)), s.at.push_back({u, v});
    }
  }
  for (std::uint32_t j = 0; j < rows; ++j) {
    for (std::uint32_t i = 0; i < columns; ++i) {
      const std::uint32_t a = j * (columns + 1) + i, b = a + 1, d = a + columns + 1, c = d + 1;
      s.corners.insert(s.corners.end(), {a, b, c, a, c, d});
    }
  }
  return s;
}
/// A square in the plane y = 0 that faces -y, `edge` wide, centred at the origin, z up.
inline Sheet frontSquare(float edge) {
  return sheet(
      1, 1,
      [=](float u, float v) {
        return std::array<float, 3>{(u - 0.5F) * edge, 0, (v - 0.5F) * edge};
      },
      [](float, float) {
        return std::array<float, 3>{0, -1, 0};
      });
}

inline std::string objOf(const Sheet& s, const std::string& library) {
  std::string text = library.empty() ? "" : "mtllib " + library + "\nusemtl paint\n";
  for (const auto& p : s.places)
    text += "v " + std::to_string(p[0]) + " " + std::to_string(p[1]) + " " + std::to_string(p[2]) + "\n";
  for (const auto& a : s.at) text += "vt " + std::to_string(a[0]) + " " + std::to_string(a[1]) + "\n";
  for (const auto& n : s.normals)
    text += "vn " + std::to_string(n[0]) + " " + std::to_string(n[1]) + " " + std::to_string(n[2]) + "\n";
  for (std::size_t i = 0; i + 2 < s.corners.size(); i += 3) {
    text += "f";
    for (std::size_t k = 0; k < 3; ++k) {
      const std::string n = std::to_string(s.corners[i + k] + 1);
      text += " " + n + "/" + n + "/" + n;
    }
    text += "\n";
  }
  return text;
}

/// glTF 2.0 (y up) with its arrays in `name`.bin beside it. `materials`, `images`: the contents of those JSON arrays.
inline void writeGltf(const std::filesystem::path& folder, const std::string& name, const Sheet& s,
                      const std::string& materials, const std::vector<std::string>& images) {
  std::string data;
  const auto put = [&](float x) { data.append(reinterpret_cast<const char*>(&x), sizeof x); };
  const auto up = [&](const std::array<float, 3>& p) { put(p[0]), put(p[2]), put(-p[1]); };
  for (const auto& p : s.places) up(p);
  for (const auto& n : s.normals) up(n);
  for (const auto& a : s.at) put(a[0]), put(1 - a[1]);
  data.append(reinterpret_cast<const char*>(s.corners.data()), 4 * s.corners.size());
  written(folder / (name + ".bin"), data);
  const std::string n = std::to_string(s.places.size());
  const auto view = [](std::size_t at, std::size_t size) {
    return R"({"buffer":0,"byteOffset":)" + std::to_string(at) + R"(,"byteLength":)" + std::to_string(size) + "}";
  };
  const std::size_t v = s.places.size();
  std::string list, textures;
  for (std::size_t i = 0; i < images.size(); ++i) {
    list += std::string(i > 0 ? "," : "") + R"({"uri":")" + images[i] + "\"}";
    textures += std::string(i > 0 ? "," : "") + R"({"source":)" + std::to_string(i) + "}";
  }
  const std::string pictures = images.empty() ? "" : R"("images":[)" + list + R"(],"textures":[)" + textures + "],";
  written(
      folder / (name + ".gltf"),
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2},"indices":3,"material":0}]}],)"
      R"("materials":[)" +
          materials + "]," + pictures + R"("accessors":[{"bufferView":0,"componentType":5126,"count":)" + n +
          R"(,"type":"VEC3","min":[-1,-1,-1],"max":[1,1,1]},{"bufferView":1,"componentType":5126,"count":)" + n +
          R"(,"type":"VEC3"},{"bufferView":2,"componentType":5126,"count":)" + n +
          R"(,"type":"VEC2"},{"bufferView":3,"componentType":5125,"count":)" + std::to_string(s.corners.size()) +
          R"(,"type":"SCALAR"}],"bufferViews":[)" + view(0, 12 * v) + "," + view(12 * v, 12 * v) + "," +
          view(24 * v, 8 * v) + "," + view(32 * v, 4 * s.corners.size()) + R"(],"buffers":[{"uri":")" + name +
          R"(.bin","byteLength":)" + std::to_string(data.size()) + "}]}");
}

}  // namespace presa::test
