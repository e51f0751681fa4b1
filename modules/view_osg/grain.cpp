#include "modules/view_osg/grain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <osg/Image>
#include <osg/Texture2D>
#include <osg/Texture3D>
#include <osg/Uniform>
#include <random>
#include <vector>

namespace presa::view {
namespace {

constexpr int kSide = 64;                  // size of the tile [texel]
constexpr int kUnit = 2, kGroundUnit = 3;  // texture units; 0 and 1 belong to lighting
constexpr int kGroundSide = 512;           // size of the ground's tile [texel]
constexpr int kCoarsestCells = 4;          // cells of the first octave per tile
constexpr int kOctaves = 4;

/// Periodic noise in [0, 1] on a lattice of `cells` per side and `depth` along z.
class Lattice {
 public:
  Lattice(int cells, int depth, std::mt19937& random) : cells_(cells), depth_(depth) {
    for (int i = 0; i < cells * cells * depth; ++i)
      values_.push_back(static_cast<float>(random() & 0xffffU) / 65535.0F);
  }
  float at(float x, float y, float z) const {
    const std::array<float, 3> p{x, y, z};
    std::array<int, 3> low{};
    std::array<float, 3> t{};
    for (std::size_t i = 0; i < 3; ++i) {
      const float scaled = p[i] * static_cast<float>(cells_);
      low[i] = static_cast<int>(std::floor(scaled));
      const float f = scaled - static_cast<float>(low[i]);
      t[i] = f * f * (3 - 2 * f);
    }
    float sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const int dx = corner & 1, dy = (corner >> 1) & 1, dz = corner >> 2;
      const float weight = (dx ? t[0] : 1 - t[0]) * (dy ? t[1] : 1 - t[1]) * (dz ? t[2] : 1 - t[2]);
      sum += weight * value(low[0] + dx, low[1] + dy, low[2] + dz);
    }
    return sum;
  }

 private:
  float value(int x, int y, int z) const {
    const auto wrap = [](int i, int length) { return static_cast<std::size_t>(i % length); };
    const auto side = static_cast<std::size_t>(cells_);
    return values_[(wrap(z, depth_) * side + wrap(y, cells_)) * side + wrap(x, cells_)];
  }
  int cells_, depth_;
  std::vector<float> values_;
};

using Octaves = std::vector<Lattice>;

/// Octaves of noise, each half as strong and twice as fine as the one before.
Octaves makeOctaves(int coarsest, int count, bool flat, std::mt19937& random) {
  Octaves octaves;
  for (int i = 0; i < count; ++i) octaves.emplace_back(coarsest << i, flat ? 1 : coarsest << i, random);
  return octaves;
}

float sum(const Octaves& octaves, float x, float y, float z) {
  float total = 0, weight = 0.5F;
  for (const Lattice& octave : octaves) {
    total += weight * octave.at(x, y, z);
    weight /= 2;
  }
  return total / (1 - weight * 2);
}

/// Luminance: clouds of four octaves. Alpha: veins, at the zero crossings of a second such noise.
osg::ref_ptr<osg::Image> makeTile() {
  std::mt19937 random(20);
  const Octaves clouds = makeOctaves(kCoarsestCells, kOctaves, false, random);
  const Octaves veins = makeOctaves(kCoarsestCells, kOctaves, false, random);
  osg::ref_ptr<osg::Image> tile = new osg::Image;
  tile->allocateImage(kSide, kSide, kSide, GL_LUMINANCE_ALPHA, GL_UNSIGNED_BYTE);
  for (int z = 0; z < kSide; ++z) {
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const auto at = [](int i) { return static_cast<float>(i) / kSide; };
        unsigned char* texel = tile->data(x, y, z);
        const float vein = 1 - std::min(1.0F, 14 * std::abs(sum(veins, at(x), at(y), at(z)) - 0.5F));
        texel[0] = static_cast<unsigned char>(255 * sum(clouds, at(x), at(y), at(z)));
        texel[1] = static_cast<unsigned char>(255 * vein);
      }
    }
  }
  return tile;
}

/// Dry earth and grass as factors of the earth's colour in red, green and blue, stored as the square root of a quarter
/// of the value.
osg::ref_ptr<osg::Image> makeGround() {
  std::mt19937 random(21);
  const Octaves patches = makeOctaves(3, 4, true, random), tufts = makeOctaves(12, 3, true, random),
                blades = makeOctaves(64, 3, true, random);
  osg::ref_ptr<osg::Image> tile = new osg::Image;
  tile->allocateImage(kGroundSide, kGroundSide, 1, GL_RGBA, GL_UNSIGNED_BYTE);
  const std::array<float, 3> grass{0.50F, 0.68F, 0.35F};
  for (int y = 0; y < kGroundSide; ++y) {
    for (int x = 0; x < kGroundSide; ++x) {
      const float u = static_cast<float>(x) / kGroundSide, v = static_cast<float>(y) / kGroundSide;
      const float tuft = sum(tufts, u, v, 0), shade = (0.35F + 1.3F * sum(blades, u, v, 0)) * (0.8F + 0.4F * tuft);
      const float t = std::clamp((0.6F * sum(patches, u, v, 0) + 0.4F * tuft - 0.33F) / 0.24F, 0.0F, 1.0F);
      const float green = t * t * (3 - 2 * t);
      tile->data(x, y)[3] = 255;
      for (std::size_t c = 0; c < 3; ++c)
        tile->data(x, y)[c] = static_cast<unsigned char>(
            255 * std::sqrt(std::clamp(shade * (1 + green * (grass[c] - 1)) / 4, 0.0F, 1.0F)));
    }
  }
  return tile;
}

}  // namespace

bool isOutdoors(const Scene& scene) {
  return std::ranges::any_of(scene.materials,
                             [](const Material& material) { return material.texture != Material::Texture::kNone; });
}

void addGrain(osg::StateSet& state, const Scene& scene) {
  state.addUniform(new osg::Uniform("grain_map", kUnit));
  state.addUniform(new osg::Uniform("grain_offset", osg::Vec3()));
  state.addUniform(new osg::Uniform("outdoors", isOutdoors(scene)));
  state.addUniform(new osg::Uniform("ground_map", kGroundUnit));
  if (!isOutdoors(scene)) return;
  osg::ref_ptr<osg::Texture2D> ground = new osg::Texture2D(makeGround());
  ground->setFilter(osg::Texture::MIN_FILTER, osg::Texture::LINEAR_MIPMAP_NEAREST);
  ground->setWrap(osg::Texture::WRAP_S, osg::Texture::REPEAT);
  ground->setWrap(osg::Texture::WRAP_T, osg::Texture::REPEAT);
  state.setTextureAttribute(kGroundUnit, ground, osg::StateAttribute::ON);
  osg::ref_ptr<osg::Texture3D> texture = new osg::Texture3D(makeTile());
  texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::LINEAR_MIPMAP_NEAREST);
  texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::LINEAR);
  for (const auto axis : {osg::Texture::WRAP_S, osg::Texture::WRAP_T, osg::Texture::WRAP_R})
    texture->setWrap(axis, osg::Texture::REPEAT);
  state.setTextureAttribute(kUnit, texture, osg::StateAttribute::ON);
}

void setGrain(osg::StateSet& body, std::size_t index) {
  const auto step = static_cast<float>(index);
  body.addUniform(new osg::Uniform("grain_offset", osg::Vec3(0.37F, 0.61F, 0.23F) * step));
}

}  // namespace presa::view
