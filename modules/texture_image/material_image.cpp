// A stiffness k(x, y) that changes along the face stores E = k (d^2 + t^2) / 2 at the depth d and the tangential
// displacement t of a finger that sticks. Its force is the slope of E: besides the spring's, -(d^2 + t^2) / 2 * grad k,
// which pushes towards the softer side. Without it a finger could be pressed into the soft side and let go on the hard
// one, and would gain energy in each round. While it slips, t is a matter of the depth and friction takes the energy.
#include <cstdio>
#include <limits>
#include <stdexcept>

#include "framework/haptics/face_height.h"
#include "framework/haptics/felt_height.h"
#include "modules/texture_image/image_on_face.h"
#include "modules/texture_image/texture_image.h"

namespace presa {
namespace {

constexpr double kShownForce = 1;      // [N]
constexpr double kUsualDepth = 0.002;  // at which the force leans by at most 45 degrees [m]

class MaterialImage final : public SurfaceEffect, public FeltHeight {
 public:
  MaterialImage(const PluginElement& element, const Material& material)
      : image_(element),
        stiffness_(element.number("stiffness")),
        friction_(element.number("friction")),
        sinks_(kShownForce / material.stiffness) {
    const double steepest = 0.5 * (1 - stiffness_) * image_.maxSlope();
    if (steepest * kUsualDepth / 2 > stiffness_)
      throw std::invalid_argument(
          "the stiffness changes too steeply: at a depth of 2 mm the force would lean by more than 45 degrees; wider "
          "tiles, a smoother image, or a stiffness nearer to 1");
  }

  void apply(const SurfaceInput& input, SurfaceContact& contact) noexcept override {
    if (stiffness_ == 1) return;
    const Here here = asked_.p_B == input.touched_B() ? asked_ : look(input);
    asked_ = {};
    const double share = shareOf(here.s, stiffness_);
    const double stuck = input.contact.state.slipping ? 0 : contact.tangential.squaredNorm();
    const Vec3 aside = here.gradient - here.gradient.dot(contact.nhat) * contact.nhat;
    const Vec3 pushed = contact.depth * contact.nhat - (contact.depth * contact.depth + stuck) / (2 * share) * aside;
    contact.stiffness *= share;
    contact.depth = pushed.norm();
    if (contact.depth > 0) contact.nhat = pushed / contact.depth;
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
