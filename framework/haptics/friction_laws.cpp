#include "framework/haptics/friction_laws.h"

#include <algorithm>
#include <map>

#include "framework/haptics/plugin_object.h"

namespace presa {
namespace {

/// A body without friction in a scene that has some.
class Frictionless final : public FrictionLaw {
 public:
  FrictionAnswer hold(const FrictionInput& input, FrictionState&) const noexcept override {
    FrictionAnswer answer;
    answer.slipping = !input.stretch.isZero(0);
    return answer;
  }
};

std::unique_ptr<FrictionLaw> makeLaw(const PluginElement& element) {
  const auto& table = pluginTable<FrictionLawPlugin>(element.plugin, "presaFrictionLawPlugin");
  return madeFor(element, [&] { return table.create(element); });
}

}  // namespace

const PluginElement* frictionElementOf(const Scene& scene, std::size_t material) {
  const auto found = std::ranges::find_if(scene.plugin_elements, [&](const PluginElement& element) {
    return element.kind == PluginKind::kFrictionLaw && element.material == static_cast<std::int32_t>(material);
  });
  return found == scene.plugin_elements.end() ? nullptr : &*found;
}

PluginElement frictionLawOf(const Scene& scene, std::size_t material) {
  if (const PluginElement* written = frictionElementOf(scene, material)) return *written;
  return {kDefaultFrictionLaw, "friction", kNoBody, {}, scene.materials[material].where, PluginKind::kFrictionLaw};
}

bool hasFriction(const Scene& scene, std::size_t material) {
  const Material& m = scene.materials[material];
  return m.friction_static > 0 || m.changed_friction || frictionElementOf(scene, material) != nullptr;
}

FrictionLaws::FrictionLaws(const Scene& scene) {
  laws_.push_back(std::make_unique<Frictionless>());
  std::map<std::size_t, const FrictionLaw*> of_material;
  for (const Body& body : scene.bodies) {
    if (!body.haptic || !hasFriction(scene, body.material)) {
      of_body_.push_back(body.haptic ? laws_.front().get() : nullptr);
      names_.emplace_back();
      continue;
    }
    const PluginElement element = frictionLawOf(scene, body.material);
    const FrictionLaw*& law = of_material[body.material];
    if (law == nullptr) {
      laws_.push_back(makeLaw(element));
      law = laws_.back().get();
    }
    of_body_.push_back(law);
    names_.push_back(element.plugin);
  }
}

std::vector<std::string> FrictionLaws::names() const {
  std::vector<std::string> names;
  for (const std::string& name : names_) {
    if (!name.empty() && std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  return names;
}

}  // namespace presa
