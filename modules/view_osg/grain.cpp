#include "modules/view_osg/grain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <osg/Image>
#include <osg/Texture3D>
#include <osg/Uniform>
#include <random>
#include <vector>

namespace presa::view {
namespace {

constexpr int kSide = 64;     // of the tile [texel]
constexpr int kUnit = 2;      // texture unit; lighting has 0 and 1
constexpr int kCoarsest = 4;  // cells of the first octave in the tile
constexpr int kOctaves = 4;

/// Noise on a lattice of `cells` per side that repeats, between 0 and 1.
class Lattice {
 public:
  Lattice(int cells, std::mt19937& random) : cells_(cells) {
    for (int i = 0; i < cells * cells * cells; ++i)
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
    const auto wrap = [&](int i) { return static_cast<std::size_t>(i % cells_); };
    const auto side = static_cast<std::size_t>(cells_);
    return values_[(wrap(z) * side + wrap(y)) * side + wrap(x)];
  }
  int cells_;
  std::vector<float> values_;
};

/// Luminance: clouds, of four octaves. Alpha: veins, where another such noise crosses its middle.
osg::ref_ptr<osg::Image> makeTile() {
  std::mt19937 random(20);
  std::vector<Lattice> clouds, veins;
  for (int octave = 0; octave < kOctaves; ++octave) {
    clouds.emplace_back(kCoarsest << octave, random);
    veins.emplace_back(kCoarsest << octave, random);
  }
  const auto sum = [](const std::vector<Lattice>& octaves, float x, float y, float z) {
    float total = 0, weight = 0.5F;
    for (const Lattice& octave : octaves) {
      total += weight * octave.at(x, y, z);
      weight /= 2;
    }
    return total / (1 - weight * 2);
  };
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

}  // namespace

bool isOutdoors(const Scene& scene) {
  return std::ranges::any_of(scene.materials,
                             [](const Material& material) { return material.texture != Material::Texture::kNone; });
}

void addGrain(osg::StateSet& state, const Scene& scene) {
  state.addUniform(new osg::Uniform("grain_map", kUnit));
  state.addUniform(new osg::Uniform("grain_kind", 0));
  state.addUniform(new osg::Uniform("grain_offset", osg::Vec3()));
  state.addUniform(new osg::Uniform("outdoors", isOutdoors(scene)));
  if (!isOutdoors(scene)) return;
  osg::ref_ptr<osg::Texture3D> texture = new osg::Texture3D(makeTile());
  texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::LINEAR_MIPMAP_LINEAR);
  texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::LINEAR);
  for (const auto axis : {osg::Texture::WRAP_S, osg::Texture::WRAP_T, osg::Texture::WRAP_R})
    texture->setWrap(axis, osg::Texture::REPEAT);
  state.setTextureAttribute(kUnit, texture, osg::StateAttribute::ON);
}

void setGrain(osg::StateSet& body, Material::Texture texture, std::size_t index) {
  body.addUniform(new osg::Uniform("grain_kind", static_cast<int>(texture)));
  const auto step = static_cast<float>(index);
  body.addUniform(new osg::Uniform("grain_offset", osg::Vec3(0.37F, 0.61F, 0.23F) * step));
}

}  // namespace presa::view
