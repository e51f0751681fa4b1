#include "apps/experiment/subject.h"

#include <algorithm>
#include <cctype>
#include <charconv>

namespace presa::experiment {
namespace {

constexpr std::size_t kLongest = 20;

bool isPseudonym(const std::string& id) {
  return !id.empty() && id.size() <= kLongest &&
         std::all_of(id.begin(), id.end(), [](unsigned char c) { return std::isalnum(c) != 0 && c < 128; });
}

}  // namespace

Subject subjectOf(const std::string& id, int number, Diagnostics& diagnostics) {
  const SourceLocation where{"--subject", 0, 0};
  if (!isPseudonym(id))
    diagnostics.error(
        910, where,
        quote(id) + " is not a pseudonym: letters and digits are allowed, at most " + std::to_string(kLongest),
        "never a name: the key belongs in a locked drawer");
  if (number > 0) return {id, number};
  const auto last = std::find_if(id.rbegin(), id.rend(), [](unsigned char c) { return std::isdigit(c) == 0; });
  const std::string digits(last.base(), id.end());
  std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (number <= 0 && !diagnostics.hasErrors())
    diagnostics.error(911, where,
                      quote(id) + " does not end in a number from 1 up; the order of trials depends on that number",
                      "add --number N, or a pseudonym such as S01");
  return {id, number};
}

}  // namespace presa::experiment
