#pragma once
#include <optional>
#include <string>
#include <vector>

#include "apps/studies/cost/front.h"

namespace presa::cost {

/// What the study says about the default setting, from the same fronts that the page draws.
struct Verdict {
  enum class Kind {
    kUnknown,   ///< the default has no error or cost to judge
    kOnFront,   ///< nothing beats it in any judged error
    kNear,      ///< within kNearFront of the front of every judged error, and no setting is better in all of them
    kTradeOff,  ///< beaten beyond kNearFront, but by nothing that is as good in the other judged errors
    kBeaten     ///< `better` may replace it
  };
  Kind kind = Kind::kUnknown;
  bool unfelt = false;                ///< every judged error of the default is below what is just noticeable
  std::optional<std::size_t> better;  ///< for kBeaten: index of the setting to take
  std::string headline;
  std::vector<std::string> details;  ///< sentences
};
Verdict verdictOf(const Result& result);

/// The metrics that decide the verdict: those whose front the study asks for, else those of its other sentences, else
/// all.
std::vector<std::string> judgedMetrics(const Result& result);

/// The setting to take instead of the default. In every judged error it is no dearer and as accurate, and it is beyond
/// kNearFront better in cost or in one of them, or more accurate in all. Nobody feels an error of it, judged or not,
/// where nobody feels that of the default. Of several the one that gains most over all.
std::optional<std::size_t> betterSetting(const Result& result);

}  // namespace presa::cost
