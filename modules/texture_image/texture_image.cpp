#include <cmath>
#include <filesystem>
#include <map>
#include <mutex>

#include "framework/haptics/face_height.h"
#include "framework/haptics/felt_height.h"
#include "modules/texture_image/height_map.h"

namespace presa {
namespace {

/// Bodies of one material share the map. Thread: those that make effects.
std::shared_ptr<const HeightMap> mapOf(const std::string& file) {
  static std::mutex mutex;
  static std::map<std::string, std::weak_ptr<const HeightMap>> known;
  const std::lock_guard lock(mutex);
  std::weak_ptr<const HeightMap>& there = known[file];
  std::shared_ptr<const HeightMap> map = there.lock();
  if (!map) there = map = std::make_shared<const HeightMap>(readGreyPng(file));
  return map;
}

class TextureImage final : public SurfaceEffect, public FeltHeight {
 public:
  explicit TextureImage(const PluginElement& element)
      : map_(mapOf(element.text("file"))),
        name_(std::filesystem::path(element.text("file")).filename().string()),
        amplitude_(element.number("amplitude")),
        width_(element.number("width")),
        height_(element.number("height")) {
    if (!(height_ > 0)) height_ = width_ * map_->height() / map_->width();
    requireGentle(amplitude_ * std::hypot(map_->maxSlopeU() / width_, map_->maxSlopeV() / height_), amplitude_,
                  "this size");
  }

  void apply(const SurfaceInput& input, SurfaceContact& contact) noexcept override {
    const FacePlace place(input);
    const Vec3 p_T = place.p_T();
    const PatternValue at = map_->at(p_T.x() / width_, p_T.y() / height_);
    addHeight(amplitude_ * (at.s - 1), place.inA({amplitude_ * at.ds_du / width_, amplitude_ * at.ds_dv / height_, 0}),
              contact);
  }
  double heightAt(const Vec3& p_T) const noexcept override {
    return amplitude_ * (map_->at(p_T.x() / width_, p_T.y() / height_).s - 1);
  }
  std::string what() const override {
    return "texture: image " + name_ + " of " + inMillimetres(amplitude_) + ", tiles of " + inMillimetres(width_) +
           " by " + inMillimetres(height_);
  }

 private:
  std::shared_ptr<const HeightMap> map_;
  std::string name_;
  double amplitude_, width_, height_;  // [m]
};

const SurfaceEffectPlugin kPlugin{
    .name = "texture_image",
    .create = [](const PluginElement& element, const World& world) -> std::unique_ptr<SurfaceEffect> {
      requireFlatSides(element, world);
      return std::make_unique<TextureImage>(element);
    }};

}  // namespace
}  // namespace presa

PRESA_SURFACE_EFFECT_PLUGIN(presa::kPlugin)
