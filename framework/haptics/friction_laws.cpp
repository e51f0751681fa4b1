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

std::unique_ptr<FrictionLaw> make(const PluginElement& element) {
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

bool hasFriction(const Scene& scene, std::size_t material) {
  const Material& m = scene.materials[material];
  return m.friction_static > 0 || m.changed_friction || frictionElementOf(scene, material) != nullptr;
}

FrictionLaws::FrictionLaws(const Scene& scene) {
  laws_.push_back(std::make_unique<Frictionless>());
  std::map<std::size_t, const FrictionLaw*> of_material;
  for (const Body& body : scene.bodies) {
    const bool rubs = body.haptic && hasFriction(scene, body.material);
    const PluginElement* written = rubs ? frictionElementOf(scene, body.material) : nullptr;
    const PluginElement element =
        written != nullptr ? *written : PluginElement{kDefaultFrictionLaw,     "friction", kNoBody, {}, body.where,
                                                      PluginKind::kFrictionLaw};
    const auto [law, is_new] = of_material.try_emplace(body.material, nullptr);
    if (rubs && law->second == nullptr) {
      laws_.push_back(make(element));
      law->second = laws_.back().get();
    }
    of_body_.push_back(rubs ? law->second : body.haptic ? laws_.front().get() : nullptr);
    names_.push_back(rubs ? element.plugin : std::string{});
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
