#include "apps/common/losses.h"

#include "apps/common/terminal/text.h"

namespace presa {
namespace {

std::string times(std::uint32_t count, const char* one, const char* more) {
  return std::to_string(count) + " " + (count == 1 ? one : more);
}

}  // namespace

std::vector<std::string> lossesOf(const RunResult& result) {
  std::vector<std::string> losses;
  if (result.coverage_lost.count > 0) {
    // the count is for all fingers together
    const std::string whose =
        result.contact_points.size() == 1 ? "finger '" + result.contact_points.front().name + "'" : "a finger";
    losses.push_back("the surface near " + whose + " was not fully known in " +
                     times(result.coverage_lost.count, "tick", "ticks") +
                     terminal::format(" (first at %.3f s): forces there are wrong", result.coverage_lost.first));
  }
  for (const RunResult::ContactPoint& point : result.contact_points) {
    const FingerSummary& sum = point.summary;
    if (sum.pop_through == 0) continue;
    losses.push_back("finger '" + point.name + "' got past a surface " + times(sum.pop_through, "time", "times") +
                     terminal::format(" (first at %.3f s): its forces after that are wrong", sum.first_pop_through));
  }
  return losses;
}

}  // namespace presa
