#include "tests/support/method_run.h"

#include <algorithm>
#include <stdexcept>

#include "experiments/runner/psychophysics/method_plugin.h"
#include "framework/haptics/plugin_object.h"
#include "framework/scene/manifest.h"

namespace presa::test {
namespace {

using namespace psychophysics;

PluginElement elementOf(const std::string& name, const std::map<std::string, std::string>& attributes) {
  for (const Manifest& manifest : manifests()) {
    const auto known = std::ranges::find(manifest.elements, name, &Manifest::Element::name);
    if (manifest.kind != PluginKind::kMethod || known == manifest.elements.end()) continue;
    PluginElement element{manifest.name, name, kNoBody, attributes, known->where, manifest.kind, -1};
    for (const Manifest::Attribute& attribute : known->attributes) {
      if (!attribute.required) element.attributes.try_emplace(attribute.name, attribute.default_value);
      if (!element.attributes.contains(attribute.name))
        throw std::invalid_argument("<" + name + "> needs the attribute '" + attribute.name + "'");
    }
    return element;
  }
  throw std::invalid_argument("no plug-in brings the method <" + name + ">");
}

}  // namespace

MethodRun::MethodRun(const std::string& name, const std::map<std::string, std::string>& attributes, std::uint64_t seed,
                     const Axis& axis) {
  const PluginElement element = elementOf(name, attributes);
  const auto& table = pluginTable<MethodPlugin>(element.plugin, "presaMethodPlugin");
  make_ = [element, axis, seed, &table] {
    return madeFor(element, [&] { return table.create(element, axis, RandomStream(seed, "method")); });
  };
  method_ = make_();
  max_trials_ = table.max_trials(element);
}

void MethodRun::answer(const Responder& positive) {
  for (std::size_t answers = 0; !method_->finished(); ++answers) {
    if (answers >= max_trials_) throw std::runtime_error("the method has not finished after its max_trials");
    method_->respond(method_->responseFor(positive(method_->next()->level)));
  }
}

std::vector<double> MethodRun::levels() const {
  std::vector<double> levels;
  for (const Trial& trial : method_->trials()) levels.push_back(trial.stimulus.level);
  return levels;
}

bool MethodRun::resumes() const {
  const std::unique_ptr<Method> fresh = make_();
  for (const Trial& trial : method_->trials()) {
    if (fresh->next() != trial.stimulus) return false;
    trial.response ? fresh->respond(*trial.response) : fresh->discard();
  }
  return fresh->next() == method_->next();
}

}  // namespace presa::test
