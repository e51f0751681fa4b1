#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace presa::xml {

/// The values that an XSD allows for an attribute.
struct ValueRule {
  /// What the text is read as; kNumber also for several numbers.
  enum class Kind { kText, kName, kPattern, kNumber, kBoolean, kWord };
  /// End of a range of numbers.
  struct Bound {
    double value = 0;      ///< in the attribute's unit
    bool included = true;  ///< the value itself is allowed
  };
  Kind kind = Kind::kText;              ///< selects the members that count
  std::optional<Bound> min,             ///< kNumber: lower end; none: unbounded
      max;                              ///< kNumber: upper end; none: unbounded
  std::size_t count = 1;                ///< kNumber: how many numbers, separated by spaces; 0: one or more
  std::size_t min_length = 0;           ///< kText: minimum length
  std::vector<std::string> words;       ///< kWord: the allowed words
  std::string pattern;                  ///< kPattern: regular expression
  std::string documentation;            ///< kPattern: the pattern in words
  std::vector<ValueRule> alternatives;  ///< union: one of these must fit; the other members are not used
};

/// "a number > 0", "3 numbers in [0, 1]", "'true' or 'false'", ...
std::string describe(const ValueRule& rule);

/// Why a value is refused.
struct ValueProblem {
  int code = 0;         ///< E116 kind, E117 range, E118 count
  std::string message;  ///< "must be a number > 0, found '-1'"
  std::string help;     ///< may be empty
};
/// The problem with `value`, or none. Numbers must be finite, although the XSD type permits NaN and INF.
std::optional<ValueProblem> problemOf(const ValueRule& rule, const std::string& value);

/// Shortest text that reads back as the same number.
std::string numberText(double value);
/// Result of readNumber: `value` is set, out of range or infinite, or no number.
enum class NumberKind { kFinite, kNotFinite, kNotANumber };
/// Allows XML white space around the number and a leading '+'. The decimal sign is always a point, in every locale.
NumberKind readNumber(std::string_view text, double& value);
std::vector<std::string> splitWords(const std::string& text);  ///< at XML white space; no empty words

}  // namespace presa::xml
