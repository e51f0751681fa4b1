#include "experiments/runner/definition/procedure.h"

#include <stdexcept>

#include "experiments/runner/definition/plugin_method.h"

namespace presa::experiment {
namespace {

using namespace psychophysics;

template <class... Ts>
struct Overloaded : Ts... {
  using Ts::operator()...;
};
template <class... Ts>
Overloaded(Ts...) -> Overloaded<Ts...>;

ForcedChoicePlan planOf(const Procedure& procedure) {
  return {procedure.task, procedure.coding, procedure.asks_for_less, procedure.balance_over};
}

}  // namespace

std::vector<std::string> mistakes(const Procedure& procedure) {
  std::vector<std::string> found =
      std::visit(Overloaded{[](const PluginElement&) { return std::vector<std::string>(); },  // its library tells them
                            [](const auto& plan) { return psychophysics::mistakes(plan); }},
                 procedure.plan);
  const bool adjusts = std::holds_alternative<AdjustmentPlan>(procedure.plan);
  if (adjusts != (procedure.task == Task::kAdjust))
    found.emplace_back("the method of adjustment needs the task \"adjust\", and the other way round");
  if (procedure.balance_over == 0) found.emplace_back("balance_over must be at least 1");
  if (!(procedure.stimulus.axis.standard > 0) && procedure.stimulus.axis.unit != Unit::kLinear)
    found.emplace_back("the standard of a logarithmic axis must be above 0");
  return found;
}

std::unique_ptr<Method> makeMethod(const Procedure& procedure, std::uint64_t seed) {
  requireNone(mistakes(procedure));
  const RandomStream stream(seed, "method"), places(seed, "places");
  std::unique_ptr<Method> method = std::visit(
      Overloaded{
          [&](const QuestPlusPlan& plan) -> std::unique_ptr<Method> { return std::make_unique<QuestPlus>(plan); },
          [&](const InterleavedPlan& plan) -> std::unique_ptr<Method> {
            return std::make_unique<Interleaved>(plan, stream);
          },
          [&](const ConstantStimuliPlan& plan) -> std::unique_ptr<Method> {
            return std::make_unique<ConstantStimuli>(plan, stream);
          },
          [&](const AdjustmentPlan& plan) -> std::unique_ptr<Method> {
            return std::make_unique<Adjustment>(plan, stream);
          },
          [&](const PluginElement& element) -> std::unique_ptr<Method> {
            return makePluginMethod(element, procedure.stimulus.axis, stream);
          }},
      procedure.plan);
  if (procedure.task == Task::kAdjust) return method;
  return std::make_unique<ForcedChoice>(std::move(method), planOf(procedure), places);
}

std::size_t maxTrials(const Procedure& procedure) {
  return std::visit(Overloaded{[](const QuestPlusPlan& plan) { return plan.stop_trials; },
                               [](const InterleavedPlan& plan) {
                                 std::size_t trials = 0;
                                 for (const StaircaseRule& rule : plan.tracks) trials += rule.stop_trials;
                                 return static_cast<std::size_t>(static_cast<double>(trials) / (1 - plan.catch_rate));
                               },
                               [](const ConstantStimuliPlan& plan) { return plan.levels.size() * plan.per_level; },
                               [](const AdjustmentPlan& plan) { return plan.trials; },
                               [](const PluginElement& element) { return maxTrials(element); }},
                    procedure.plan);
}

}  // namespace presa::experiment
