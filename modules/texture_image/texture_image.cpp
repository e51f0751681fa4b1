#include "modules/texture_image/texture_image.h"

#include "framework/haptics/face_height.h"
#include "framework/haptics/felt_height.h"
#include "modules/texture_image/image_on_face.h"

namespace presa {
namespace {

class TextureImage final : public SurfaceEffect, public FeltHeight {
 public:
  explicit TextureImage(const PluginElement& element) : image_(element), amplitude_(element.number("amplitude")) {
    requireGentle(amplitude_ * image_.maxSlope(), amplitude_, "this size");
  }

  void apply(const SurfaceInput& input, SurfaceContact& contact) noexcept override {
    const FacePlace place(input);
    const PatternValue at = image_.at(place.p_T());
    addHeight(amplitude_ * (at.s - 1), place.inA({amplitude_ * at.ds_du, amplitude_ * at.ds_dv, 0}), contact);
  }
  double heightAt(const Vec3& p_T) const noexcept override { return amplitude_ * (image_.at(p_T).s - 1); }
  std::string what() const override {
    return "texture: image " + image_.name() + " of " + inMillimetres(amplitude_) + ", " + image_.tiles();
  }

 private:
  ImageOnFace image_;
  double amplitude_;  // [m]
};

}  // namespace

std::unique_ptr<SurfaceEffect> makeTextureImage(const PluginElement& element) {
  return std::make_unique<TextureImage>(element);
}

}  // namespace presa
