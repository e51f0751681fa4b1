#pragma once
#include <osg/Image>
#include <osgDB/ReadFile>
#include <stdexcept>
#include <string>

namespace presa::test {

struct Color {
  int r, g, b;
};

/// A PNG file, read. Its user links PkgConfig::OSG.
class PngPicture {
 public:
  explicit PngPicture(const std::string& file) : image_(osgDB::readRefImageFile(file)) {
    if (!image_) throw std::runtime_error("no picture " + file);
  }
  int width() const { return image_->s(); }
  int height() const { return image_->t(); }
  /// x from the left, y from the top.
  Color at(int x, int y) const {
    const unsigned char* p = image_->data(x, image_->t() - 1 - y);
    return {p[0], p[1], p[2]};
  }

 private:
  osg::ref_ptr<osg::Image> image_;
};

/// Pixels in the violet of joints.
inline int violetIn(const std::string& file) {
  const PngPicture picture(file);
  int count = 0;
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) {
      const Color c = picture.at(x, y);
      count += c.b > 90 && 3 * c.b > 4 * c.r && 2 * c.b > 3 * c.g;
    }
  return count;
}

}  // namespace presa::test
