#include "experiments/runner/definition/plugin_method.h"

#include <cmath>

#include "experiments/runner/psychophysics/method_plugin.h"
#include "framework/haptics/plugin_object.h"

namespace presa::experiment {
namespace {

using namespace psychophysics;

enum MethodCode { kAgainstContract = 617 };

const MethodPlugin& tableOf(const PluginElement& element) {
  return pluginTable<MethodPlugin>(element.plugin, "presaMethodPlugin");
}

[[noreturn]] void refuseMethod(const PluginElement& element, const std::string& why) {
  Diagnostics diagnostics;
  diagnostics.error(kAgainstContract, element.where, "the method of plug-in '" + element.plugin + "' " + why,
                    "report this to the author of the plug-in");
  throw InputError(std::move(diagnostics));
}

/// Calls the plug-in; what it throws becomes E617.
template <class Call>
auto guarded(const PluginElement& element, const Call& call) -> decltype(call()) {
  std::string why;
  try {
    return call();
  } catch (const std::exception& error) {
    why = std::string(": ") + error.what();
  } catch (...) {
    why = " what is no std::exception";
  }
  refuseMethod(element, "throws during the session" + why);
}

class PluginMethod final : public Method {
 public:
  PluginMethod(const PluginElement& element, const Axis& axis, const RandomStream& stream)
      : element_(element), inner_(madeFor(element, [&] { return tableOf(element).create(element, axis, stream); })) {
    start();
  }

  Response responseFor(bool positive) const override {
    return guarded(element_, [&] { return inner_->responseFor(positive); });
  }

 private:
  void update(Trial& trial) override {
    ++answers_;
    guarded(element_, [&] { inner_->respond(*trial.response); });
    trial.response = inner_->trials().back().response;
  }

  std::optional<Stimulus> choose() override {
    const std::optional<Stimulus>& next = inner_->next();
    if (next && !std::isfinite(next->level)) refuseMethod(element_, "presents a level that is no finite number");
    if (next && answers_ >= max_)
      refuseMethod(element_, "has not finished after the " + std::to_string(max_) + " answers that it announces");
    return next;
  }

  Stimulus again(const Stimulus&) override {
    guarded(element_, [&] { inner_->discard(); });
    return *choose();  // Method::discard always offers a trial
  }

  PluginElement element_;
  std::unique_ptr<Method> inner_;
  std::size_t answers_ = 0, max_ = maxTrials(element_);
};

}  // namespace

std::unique_ptr<Method> makePluginMethod(const PluginElement& element, const Axis& axis, const RandomStream& stream) {
  return std::make_unique<PluginMethod>(element, axis, stream);
}

std::size_t maxTrials(const PluginElement& element) {
  const std::size_t trials = tableOf(element).max_trials(element);
  if (trials == 0) refuseMethod(element, "announces no trial");
  return trials;
}

}  // namespace presa::experiment
