#include "experiments/runner/psychophysics/method.h"

#include <stdexcept>

namespace presa::psychophysics {

void replay(Method& method, std::span<const Trial> log) {
  for (const Trial& trial : log) {
    if (method.next() != trial.stimulus) {
      throw std::runtime_error("trial " + std::to_string(trial.stimulus.trial + 1) +
                               " of the log is not the one this definition and seed present");
    }
    if (trial.response) {
      method.respond(*trial.response);
    } else {
      method.discard();
    }
  }
}

void requireNone(const std::vector<std::string>& mistakes) {
  if (mistakes.empty()) return;
  std::string text = mistakes.front();
  for (std::size_t i = 1; i < mistakes.size(); ++i) text += "; " + mistakes[i];
  throw std::invalid_argument(text);
}

}  // namespace presa::psychophysics
