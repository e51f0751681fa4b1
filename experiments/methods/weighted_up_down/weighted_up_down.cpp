#include <algorithm>
#include <stdexcept>

#include "experiments/runner/psychophysics/method_plugin.h"

namespace presa::psychophysics {
namespace {

std::size_t trialsOf(const PluginElement& element) { return static_cast<std::size_t>(element.number("trials")); }

/// Weighted up/down [Kaernbach1991]: steps cancel where p * down = (1 - p) * up.
class WeightedUpDown final : public Method {
 public:
  explicit WeightedUpDown(const PluginElement& element)
      : level_(element.number("start")),
        up_(element.number("step")),
        down_(up_ * (1 - element.number("target")) / element.number("target")),
        min_(element.number("min")),
        max_(element.number("max")),
        left_(trialsOf(element)) {
    if (!(min_ <= level_ && level_ <= max_)) throw std::runtime_error("start must lie between min and max");
    start();
  }

 private:
  void update(Trial& trial) override {
    --left_;
    level_ = std::clamp(level_ + (trial.response->positive ? -down_ : up_), min_, max_);
  }
  std::optional<Stimulus> choose() override {
    if (left_ == 0) return std::nullopt;
    return Stimulus{.level = level_};
  }

  double level_, up_, down_, min_, max_;
  std::size_t left_;
};

const MethodPlugin kPlugin{
    .name = "weighted_up_down",
    .create = [](const PluginElement& element, const Axis&, const RandomStream&) -> std::unique_ptr<Method> {
      return std::make_unique<WeightedUpDown>(element);
    },
    .max_trials = trialsOf};

}  // namespace
}  // namespace presa::psychophysics

PRESA_METHOD_PLUGIN(presa::psychophysics::kPlugin)
