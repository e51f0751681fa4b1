// The stiffness k(x, y) changes along the face, with the force of its stored energy
// (framework/haptics/graded_stiffness.h).
#include <cstdio>
#include <limits>
#include <stdexcept>

#include "framework/haptics/face_height.h"
#include "framework/haptics/felt_height.h"
#include "framework/haptics/graded_stiffness.h"
#include "modules/texture_image/image_on_face.h"
#include "modules/texture_image/texture_image.h"

namespace presa {
namespace {

constexpr double kShownForce = 1;  // [N]

class MaterialImage final : public SurfaceEffect, public FeltHeight {
 public:
  MaterialImage(const PluginElement& element, const Material& material)
      : image_(element),
        stiffness_(element.number("stiffness")),
        friction_(element.number("friction")),
        sinks_(kShownForce / material.stiffness) {
    if (leansTooFar(0.5 * (1 - stiffness_) * image_.maxSlope(), stiffness_))
      throw std::invalid_argument(
          "the stiffness changes too steeply: at a depth of 2 mm the force would lean by more than 45 degrees; wider "
          "tiles, a smoother image, or a stiffness nearer to 1");
  }

  void apply(const SurfaceInput& input, SurfaceContact& contact) noexcept override {
    if (stiffness_ == 1) return;
    const Here here = asked_.p_B == input.touched_B() ? asked_ : look(input);
    asked_ = {};
    gradeStiffness(shareOf(here.s, stiffness_), here.gradient, input, contact);
  }
  bool changesFriction() const override { return friction_ != 1; }
  double friction(const SurfaceInput& input) noexcept override {
    asked_ = look(input);
    return shareOf(asked_.s, friction_);
  }
  // under the shown force a finger sinks deeper where it is soft; where all is as hard, dark is slippery
  double heightAt(const Vec3& p_T) const noexcept override {
    const double s = image_.at(p_T).s;
    return stiffness_ != 1 ? sinks_ * (1 - 1 / shareOf(s, stiffness_)) : sinks_ * (shareOf(s, friction_) - 1);
  }
  std::string what() const override {
    std::string text = "material by image " + image_.name() + ", black: ";
    if (stiffness_ != 1) text += percent(stiffness_) + " of the stiffness" + (friction_ != 1 ? ", " : "");
    if (friction_ != 1) text += percent(friction_) + " of the friction";
    return text + "; " + image_.tiles();
  }

 private:
  /// The image at a place of the face.
  struct Here {
    Vec3 p_B = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
    double s = 0;
    Vec3 gradient = Vec3::Zero();  // of the share of the stiffness, in A [1/m]
  };
  Here look(const SurfaceInput& input) const noexcept {
    const FacePlace place(input);
    const PatternValue at = image_.at(place.p_T());
    if (stiffness_ == 1) return {Vec3::Zero(), at.s, Vec3::Zero()};
    const double slope = 0.5 * (1 - stiffness_);
    return {input.touched_B(), at.s, place.inA({slope * at.ds_du, slope * at.ds_dv, 0})};
  }
  static double shareOf(double s, double black) noexcept { return black + (1 - black) * 0.5 * (s + 1); }
  static std::string percent(double share) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g %%", 100 * share);
    return text;
  }

  ImageOnFace image_;
  double stiffness_, friction_;  // of black
  double sinks_;                 // white, under the shown force [m]
  Here asked_;                   // by the friction of this tick
};

}  // namespace

std::unique_ptr<SurfaceEffect> makeMaterialImage(const PluginElement& element, const Material& material) {
  return std::make_unique<MaterialImage>(element, material);
}

}  // namespace presa
