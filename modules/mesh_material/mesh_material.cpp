// Per-triangle and per-vertex materials: shares by vertex (mesh_shares.h), found where a tool touches
// (touched_share.h), and the force of their stored energy (framework/haptics/graded_stiffness.h).
#include <algorithm>
#include <cctype>
#include <cstdio>
#include <limits>
#include <stdexcept>

#include "framework/haptics/felt_height.h"
#include "framework/haptics/graded_stiffness.h"
#include "modules/mesh_material/touched_share.h"

namespace presa {
namespace {

constexpr double kShownForce = 1;     // [N]
constexpr double kShownReach = 1e-4;  // of a drawn place from the mesh [m]

constexpr std::size_t kListed = 20;

/// Names come from the file: no control characters reach the terminal.
std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kListed); ++i) text += (i == 0 ? "" : ", ") + names[i];
  if (names.size() > kListed) text += " and " + std::to_string(names.size() - kListed) + " more";
  std::ranges::replace_if(
      text, [](unsigned char c) { return std::iscntrl(c) != 0; }, '?');
  return text.empty() ? "none" : text;
}

/// Throws std::invalid_argument if the file lacks the part or the colours that the element names.
void check(const PluginElement& element, const MeshShares& shares, const World& world) {
  const Body& body = world.scene.bodies[static_cast<std::size_t>(element.body)];
  const std::string mesh = "mesh " + std::get<MeshRef>(body.haptic->shape).file;
  if (element.element == "material_colour") {
    if (!shares.has_colours)
      throw std::invalid_argument(mesh + " has no colours of vertices; PLY, OBJ and glTF can have them");
    return;
  }
  const std::string& name = element.text("name");
  if (std::ranges::find(shares.parts, name) == shares.parts.end())
    throw std::invalid_argument(mesh + " has no triangles of a material '" + name +
                                "'; materials of its triangles: " + listed(shares.parts));
  const auto same = [&](const PluginElement* each) {
    return each->element == element.element && each->text("name") == name;
  };
  if (std::ranges::count_if(elementsBeside(element, world), same) > 1)
    throw std::invalid_argument("the material has two <material_part> of the name '" + name + "'");
}

std::string percent(double share) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g %%", 100 * share);
  return text;
}

std::string described(const PluginElement& element) {
  const bool of_part = element.element != "material_colour";
  const double stiffness = element.number("stiffness"), friction = element.number("friction");
  std::string text = of_part ? "material of the mesh's part " + element.text("name") + ": "
                             : "material by the colours of the mesh's vertices, black: ";
  if (stiffness == 1 && friction == 1) return text + "as it stands";
  if (stiffness != 1) text += percent(stiffness) + " of the stiffness" + (friction != 1 ? ", " : "");
  return friction != 1 ? text + percent(friction) + " of the friction" : text;
}

/// Of the elements of a material the first acts for all, because a triangle at the border of two parts has shares of
/// both.
class MeshMaterial final : public SurfaceEffect, public FeltHeight {
 public:
  MeshMaterial(const PluginElement& element, const World& world)
      : body_(element.body),
        finder_(sharesOf(element, world), world.meshes[static_cast<std::size_t>(body_)].haptic_tree,
                world.scene.bodies[static_cast<std::size_t>(body_)].haptic->X_BG),
        what_(described(element)),
        sinks_(kShownForce / world.scene.materialOf(world.scene.bodies[static_cast<std::size_t>(body_)]).stiffness) {
    check(element, finder_.shares(), world);
    const PluginElement& first = *elementsBeside(element, world).front();
    const bool acts = first.element == element.element && first.attributes == element.attributes;
    grades_stiffness_ = acts && finder_.shares().grades_stiffness;
    grades_friction_ = acts && finder_.shares().grades_friction;
  }

  void apply(const SurfaceInput& input, SurfaceContact& contact) noexcept override {
    if (!grades_stiffness_) return;
    const TouchedShare here = asked_.is(input) ? asked_.share : finder_.at(input, body_);
    asked_ = {};
    if (here.stiffness != 1 || !here.gradient.isZero(0)) gradeStiffness(here.stiffness, here.gradient, input, contact);
  }
  bool changesFriction() const override { return grades_friction_; }
  double friction(const SurfaceInput& input) noexcept override {
    if (!grades_friction_) return 1;
    asked_ = {input.tool, input.time, input.contact.state.god_object, finder_.at(input, body_)};
    return asked_.share.friction;
  }
  double heightAt(const Vec3&) const noexcept override { return 0; }
  // under the shown force a finger sinks deeper where it is soft; where all is as hard, dark is slippery
  double heightAt(const Vec3& p_T, const Pose& X_BT) const noexcept override {
    if (!grades_stiffness_ && !grades_friction_) return 0;
    const TouchedShare here = finder_.near(X_BT * p_T, kShownReach);
    return sinks_ * (grades_stiffness_ ? 1 - 1 / here.stiffness : here.friction - 1);
  }
  std::string what() const override { return what_; }

 private:
  /// By the friction of this tick.
  struct Asked {
    std::size_t tool = 0;
    double time = 0;
    Vec3 x = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
    TouchedShare share;
    bool is(const SurfaceInput& input) const noexcept {
      return x == input.contact.state.god_object && tool == input.tool && time == input.time;
    }
  };

  std::int32_t body_;
  ShareFinder finder_;
  std::string what_;
  double sinks_;  // as it stands, under the shown force [m]
  bool grades_stiffness_ = false, grades_friction_ = false;
  Asked asked_;
};

const SurfaceEffectPlugin kPlugin{
    .name = "mesh_material",
    .create = [](const PluginElement& element, const World& world) -> std::unique_ptr<SurfaceEffect> {
      return std::make_unique<MeshMaterial>(element, world);
    }};

}  // namespace
}  // namespace presa

PRESA_SURFACE_EFFECT_PLUGIN(presa::kPlugin)
