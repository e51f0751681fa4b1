#include "modules/texture_image/image_on_face.h"

#include <cmath>
#include <filesystem>
#include <map>
#include <mutex>

#include "framework/haptics/face_height.h"

namespace presa {
namespace {

std::shared_ptr<const HeightMap> mapOf(const std::string& file) {
  static std::mutex mutex;
  static std::map<std::string, std::weak_ptr<const HeightMap>> known;
  const std::lock_guard lock(mutex);
  std::weak_ptr<const HeightMap>& there = known[file];
  std::shared_ptr<const HeightMap> map = there.lock();
  if (!map) there = map = std::make_shared<const HeightMap>(readGreyPng(file));
  return map;
}

}  // namespace

ImageOnFace::ImageOnFace(const PluginElement& element)
    : map_(mapOf(element.text("file"))),
      name_(std::filesystem::path(element.text("file")).filename().string()),
      width_(element.number("width")),
      height_(element.number("height")) {
  if (!(height_ > 0)) height_ = width_ * map_->height() / map_->width();
}

PatternValue ImageOnFace::at(const Vec3& p_T) const noexcept {
  PatternValue value = map_->at(p_T.x() / width_, p_T.y() / height_);
  value.ds_du /= width_;
  value.ds_dv /= height_;
  return value;
}

double ImageOnFace::maxSlope() const noexcept {
  return std::hypot(map_->maxSlopeU() / width_, map_->maxSlopeV() / height_);
}

std::string ImageOnFace::tiles() const { return "tiles of " + inMillimetres(width_) + " by " + inMillimetres(height_); }

}  // namespace presa
