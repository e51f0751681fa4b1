#include "modules/view_osg/frame_image.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <osg/GraphicsContext>
#include <osgDB/FileNameUtils>
#include <osgDB/Registry>
#include <sstream>

#include "framework/geometry/srgb.h"

namespace presa::view {
namespace {

constexpr int kLightSteps = 4096;

struct SrgbTables {
  std::array<float, 256> light;
  std::array<unsigned char, kLightSteps + 1> code;
  SrgbTables() {
    for (std::size_t i = 0; i < light.size(); ++i)
      light[i] = static_cast<float>(srgb::toLinear(static_cast<double>(i) / 255));
    for (std::size_t i = 0; i < code.size(); ++i)
      code[i] = static_cast<unsigned char>(std::lround(255 * srgb::fromLinear(static_cast<double>(i) / kLightSteps)));
  }
};

}  // namespace

void FrameGrabber::operator()(osg::RenderInfo& info) const {
  if (!armed_) return;
  armed_ = false;
  const osg::GraphicsContext::Traits* traits = info.getState()->getGraphicsContext()->getTraits();
  image_ = new osg::Image;
  // as the frame buffer holds it: for RGB, Mesa would make a program and draw the frame once more
  image_->readPixels(0, 0, traits->width, traits->height, GL_BGRA, GL_UNSIGNED_BYTE);
}

osg::ref_ptr<osg::Image> FrameGrabber::take() {
  const osg::ref_ptr<osg::Image> read = std::exchange(image_, nullptr);
  if (!read) return nullptr;
  osg::ref_ptr<osg::Image> image = new osg::Image;
  image->allocateImage(read->s(), read->t(), 1, GL_RGB, GL_UNSIGNED_BYTE, 1);
  for (int y = 0; y < read->t(); ++y) {
    const unsigned char* from = read->data(0, y);
    unsigned char* to = image->data(0, y);
    for (int x = 0; x < read->s(); ++x, from += 4, to += 3) to[0] = from[2], to[1] = from[1], to[2] = from[0];
  }
  return image;
}

osg::ref_ptr<osg::Image> shrink(osg::Image& image, int factor) {
  if (factor == 1) return &image;
  static const SrgbTables tables;
  osg::ref_ptr<osg::Image> small = new osg::Image;
  small->allocateImage(image.s() / factor, image.t() / factor, 1, GL_RGB, GL_UNSIGNED_BYTE, 1);
  const float scale = kLightSteps / static_cast<float>(factor * factor);
  std::vector<float> sums(3 * static_cast<std::size_t>(small->s()));
  for (int y = 0; y < small->t(); ++y) {
    std::ranges::fill(sums, 0.0F);
    for (int dy = 0; dy < factor; ++dy) {
      const unsigned char* code = image.data(0, factor * y + dy);
      for (std::size_t x = 0; x < sums.size(); x += 3)
        for (int dx = 0; dx < factor; ++dx)
          for (std::size_t c = 0; c < 3; ++c) sums[x + c] += tables.light[*code++];
    }
    unsigned char* out = small->data(0, y);
    for (const float sum : sums) *out++ = tables.code[static_cast<std::size_t>(sum * scale + 0.5F)];
  }
  return small;
}

osg::ref_ptr<osg::Image> cutOut(const osg::Image& over_black, const osg::Image& over_white) {
  osg::ref_ptr<osg::Image> image = new osg::Image;
  image->allocateImage(over_black.s(), over_black.t(), 1, GL_RGBA, GL_UNSIGNED_BYTE, 1);
  for (int y = 0; y < image->t(); ++y) {
    for (int x = 0; x < image->s(); ++x) {
      const unsigned char* black = over_black.data(x, y);
      const unsigned char* white = over_white.data(x, y);
      int through = 0;  // of the background, summed over the three channels
      for (std::size_t c = 0; c < 3; ++c) through += std::max(0, white[c] - black[c]);
      const double alpha = 1 - through / 765.0;
      unsigned char* pixel = image->data(x, y);
      // over black, a colour is alpha times its own
      for (std::size_t c = 0; c < 3; ++c)
        pixel[c] = alpha > 0 ? static_cast<unsigned char>(std::lround(std::min(255.0, black[c] / alpha))) : 0;
      pixel[3] = static_cast<unsigned char>(std::lround(255 * alpha));
    }
  }
  return image;
}

std::string writePng(const osg::Image& image, const std::string& file) {
  osgDB::ReaderWriter* const writer =
      osgDB::Registry::instance()->getReaderWriterForExtension(osgDB::getLowerCaseFileExtension(file));
  if (writer == nullptr) return "OpenSceneGraph has no writer for this file name (it should end in .png)";
  std::ostringstream bytes;  // OpenSceneGraph does not check for write errors of the disk
  // level 3 takes half the time of the default for a file that is a tenth larger
  const osg::ref_ptr<osgDB::Options> options = new osgDB::Options("PNG_COMPRESSION 3");
  const osgDB::ReaderWriter::WriteResult result = writer->writeImage(image, bytes, options);
  if (!result.success()) return result.message().empty() ? "the picture cannot be made" : result.message();
  errno = 0;
  std::ofstream out(file, std::ios::binary);
  const bool opened = out.is_open();
  out << bytes.view();
  out.close();
  if (out) return {};
  const std::string reason = errno != 0 ? std::strerror(errno) : "the file cannot be written";
  if (opened) std::remove(file.c_str());  // incomplete file
  return reason;
}

}  // namespace presa::view
