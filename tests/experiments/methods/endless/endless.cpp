#include <limits>
#include <stdexcept>

#include "experiments/runner/psychophysics/method_plugin.h"

namespace presa::psychophysics {
namespace {

/// Announces three answers and never finishes; its first level is `level`, or no number without it. With `throws`, the first answer
/// throws.
class Endless final : public Method {
 public:
  Endless(double level, bool throws) : level_(level), throws_(throws) { start(); }

 private:
  void update(Trial&) override {
    if (throws_) throw std::out_of_range("no level left");
  }
  std::optional<Stimulus> choose() override { return Stimulus{.level = level_}; }
  double level_;
  bool throws_;
};

const MethodPlugin kPlugin{
    .name = "endless",
    .create = [](const PluginElement& element, const Axis&, const RandomStream&) -> std::unique_ptr<Method> {
      if (element.attributes.contains("nothing")) return nullptr;
      return std::make_unique<Endless>(
          element.attributes.contains("level") ? element.number("level") : std::numeric_limits<double>::quiet_NaN(),
          element.attributes.contains("throws"));
    },
    .max_trials = [](const PluginElement&) { return std::size_t{3}; }};

}  // namespace
}  // namespace presa::psychophysics

PRESA_METHOD_PLUGIN(presa::psychophysics::kPlugin)
