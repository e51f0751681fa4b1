#include "modules/view_osg/models/model_images.h"

#include <algorithm>
#include <cmath>
#include <osgDB/Registry>
#include <sstream>

#include "framework/core/diagnostics/refuse.h"
#include "framework/geometry/image_size.h"
#include "framework/input/input.h"

namespace presa::view {
namespace {

enum ImageCode { kUndecodable = 266 };

[[noreturn]] void refuseTexture(const Model& model, const ModelTexture& texture, const std::string& why) {
  refuse(kUndecodable, model.file, "its texture " + quote(texture.name) + " " + why, "save it again as PNG or JPEG");
}

/// Samples of 8 bits per channel, three channels.
osg::ref_ptr<osg::Image> asRgb(const osg::Image& from) {
  const auto channels = static_cast<std::size_t>(osg::Image::computeNumComponents(from.getPixelFormat()));
  const bool wide = from.getDataType() == GL_UNSIGNED_SHORT;
  const std::size_t bytes = wide ? 2 : 1, high = wide ? 1 : 0;  // of 16 bits, the upper ones: little-endian
  osg::ref_ptr<osg::Image> rgb = new osg::Image;
  rgb->allocateImage(from.s(), from.t(), 1, GL_RGB, GL_UNSIGNED_BYTE, 1);
  for (int y = 0; y < from.t(); ++y) {
    const unsigned char* source = from.data(0, y) + high;
    unsigned char* to = rgb->data(0, y);
    for (int x = 0; x < from.s(); ++x, source += channels * bytes, to += 3)
      for (std::size_t c = 0; c < 3; ++c) to[c] = source[channels < 3 ? 0 : c * bytes];
  }
  return rgb;
}

}  // namespace

osg::ref_ptr<osg::Image> decodeTexture(const Model& model, const ModelTexture& texture) {
  std::string read;
  if (texture.bytes.empty()) {
    input::Refusal refusal;
    std::optional<std::string> bytes = input::read(texture.file, kMaxTextureBytes, refusal);
    if (!bytes) refuseTexture(model, texture, refusal.what);
    read = std::move(*bytes);
  }
  const std::string& bytes = texture.bytes.empty() ? read : texture.bytes;
  const std::optional<ImageSize> size = imageSize(bytes);
  const bool same =
      size && static_cast<int>(size->width) == texture.width && static_cast<int>(size->height) == texture.height;
  if (!same) refuseTexture(model, texture, "has changed since it was loaded");
  const char* const ending = size->format == ImageSize::Format::kPng ? "png" : "jpeg";
  osgDB::ReaderWriter* const reader = osgDB::Registry::instance()->getReaderWriterForExtension(ending);
  if (reader == nullptr)
    refuseTexture(model, texture, std::string("cannot be decoded: OSG has no reader for ") + ending);
  std::istringstream stream(bytes);
  const osg::ref_ptr<osg::Image> image = reader->readImage(stream).takeImage();
  if (!image || image->data() == nullptr || image->s() != texture.width || image->t() != texture.height)
    refuseTexture(model, texture, "is damaged and cannot be decoded");
  const bool plain = image->getPixelFormat() == GL_RGB && image->getDataType() == GL_UNSIGNED_BYTE;
  return plain ? image : asRgb(*image);
}

Vec3 meanOf(const osg::Image& image) {
  constexpr int kStep = 7;  // every so many rows and columns are enough
  Vec3 sum = Vec3::Zero();
  double count = 0;
  for (int y = 0; y < image.t(); y += kStep) {
    for (int x = 0; x < image.s(); x += kStep, ++count) {
      const unsigned char* pixel = image.data(x, y);
      sum += Vec3(pixel[0], pixel[1], pixel[2]) / 255;
    }
  }
  return sum / count;
}

bool isGrey(const osg::Image& image) {
  for (int y = 0; y < image.t(); ++y) {
    for (int x = 0; x < image.s(); ++x) {
      const unsigned char* pixel = image.data(x, y);
      // JPEG keeps grey only nearly
      if (std::abs(pixel[0] - pixel[1]) > 4 || std::abs(pixel[1] - pixel[2]) > 4) return false;
    }
  }
  return true;
}

osg::ref_ptr<osg::Image> normalsOf(const osg::Image& heights) {
  osg::ref_ptr<osg::Image> normals = new osg::Image;
  const int width = heights.s(), height = heights.t();
  normals->allocateImage(width, height, 1, GL_RGB, GL_UNSIGNED_BYTE, 1);
  const auto at = [&](int x, int y) { return *heights.data((x + width) % width, (y + height) % height) / 255.0F; };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      Eigen::Vector3f n((at(x - 1, y) - at(x + 1, y)) / 2, (at(x, y - 1) - at(x, y + 1)) / 2, 1);
      n.normalize();
      for (int c = 0; c < 3; ++c) normals->data(x, y)[c] = static_cast<unsigned char>(std::lround(127.5F * (n[c] + 1)));
    }
  }
  return normals;
}

}  // namespace presa::view
