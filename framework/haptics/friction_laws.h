#pragma once
#include <memory>
#include <string>
#include <vector>

#include "framework/haptics/friction_law.h"
#include "framework/scene/scene.h"

namespace presa {

/// The friction laws of a scene, by body.
class FrictionLaws {
 public:
  /// Loads the plug-ins of the materials that have friction and that a finger can touch. Throws InputError: the errors
  /// of pluginTable; E596 a law that cannot be made.
  explicit FrictionLaws(const Scene& scene);

  /// Null only for bodies that no finger can touch. Haptic thread.
  const FrictionLaw* of(std::int32_t body) const noexcept { return of_body_[static_cast<std::size_t>(body)]; }
  /// Plug-in of the body's law: "friction_cone".
  const std::string& nameOf(std::int32_t body) const { return names_[static_cast<std::size_t>(body)]; }
  /// The plug-ins, each once, in the order of the bodies.
  std::vector<std::string> names() const;

 private:
  std::vector<std::unique_ptr<FrictionLaw>> laws_;  // the first: none
  std::vector<const FrictionLaw*> of_body_;
  std::vector<std::string> names_;  // by body; empty: no friction
};

/// The element that gives the material's law, or null: kDefaultFrictionLaw.
const PluginElement* frictionElementOf(const Scene& scene, std::size_t material);
/// The same with the default filled in, which stands for `<friction>` itself.
PluginElement frictionLawOf(const Scene& scene, std::size_t material);
/// Whether fingers feel friction on the material, now or after the surface change.
bool hasFriction(const Scene& scene, std::size_t material);

}  // namespace presa
