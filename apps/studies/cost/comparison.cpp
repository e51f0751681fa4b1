#include "apps/studies/cost/comparison.h"

#include <algorithm>
#include <cmath>

namespace presa::cost {

Value Sum::rms() const { return count > 0 ? Value(std::sqrt(squares / static_cast<double>(count))) : std::nullopt; }
Value Sum::peak() const { return count > 0 ? Value(largest) : std::nullopt; }

Value worstOf(const std::vector<Sum>& sums, Value (Sum::*result)() const) {
  Value worst;
  for (const Sum& sum : sums) {
    if (const Value v = (sum.*result)()) worst = std::max(worst.value_or(0), *v);
  }
  return worst;
}

}  // namespace presa::cost
