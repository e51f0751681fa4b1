#include <array>
#include <utility>

#include "framework/scene/scene_parts.h"

namespace presa {
namespace {

enum FrictionPresetCode { kPresetAndStatic = 236 };

/// Static coefficients between the tip of an index finger and a material, as section 3.6.1 of the PERCRO paper quotes
/// them. The schema names the same.
constexpr std::array kFingertipOn{std::pair{"rayon", "0.42"}, std::pair{"suede", "0.61"},
                                  std::pair{"sandpaper", "1.67"}};

}  // namespace

void resolveFrictionPresets(const xml::Element& root, Diagnostics& diagnostics) {
  for (const xml::Element& material : materialElements(root)) {
    for (xml::Element friction : material.children("friction")) {
      if (!friction.hasAttribute("preset") || friction.flawed("preset")) continue;
      const std::string preset = friction.attribute("preset");
      const SourceLocation where = friction.where("preset");
      if (friction.hasAttribute("static")) {
        diagnostics.error(kPresetAndStatic, where,
                          "friction of " + material.label() + " has two static coefficients, preset " + quote(preset) +
                              " and static " + quote(friction.attribute("static")),
                          "write one of them; dynamic may stand beside either");
        continue;
      }
      for (const auto& [name, coefficient] : kFingertipOn) {
        if (preset == name) friction.setAttribute("static", coefficient, where);
      }
      friction.removeAttribute("preset");
    }
  }
}

}  // namespace presa
