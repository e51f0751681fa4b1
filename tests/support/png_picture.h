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

}  // namespace presa::test
