#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace presa::xml {

/// What an XSD allows as the value of an attribute.
struct ValueRule {
  enum class Kind { kText, kName, kPattern, kNumber, kBoolean, kWord };
  struct Bound {
    double value = 0;
    bool included = true;
  };
  Kind kind = Kind::kText;
  std::optional<Bound> min, max;        ///< of a number
  std::size_t count = 1;                ///< numbers in the value, separated by spaces; 0: any, at least one
  std::size_t min_length = 0;           ///< of a text
  std::vector<std::string> words;       ///< of kWord: all that is allowed
  std::string pattern;                  ///< of kPattern
  std::string documentation;            ///< of kPattern: the pattern in words
  std::vector<ValueRule> alternatives;  ///< of a union: one of them must fit, this rule itself says nothing
};

/// "a number > 0", "3 numbers in [0, 1]", "'true' or 'false'", ...
std::string describe(const ValueRule& rule);

struct ValueProblem {
  int code = 0;         ///< E116 kind, E117 range, E118 count
  std::string message;  ///< "must be a number > 0, found '-1'"
  std::string help;     ///< may be empty
};
/// What is wrong with `value`, if anything. Numbers must be finite, whatever the XSD type says of NaN and INF.
std::optional<ValueProblem> problemOf(const ValueRule& rule, const std::string& value);

/// Shortest text that reads back as the same number.
std::string numberText(double value);
enum class NumberKind { kFinite, kNotFinite, kNotANumber };
/// XML white space around the number and a leading '+' are allowed; decimal point, never the locale's sign.
NumberKind readNumber(std::string_view text, double& value);
std::vector<std::string> splitWords(const std::string& text);

}  // namespace presa::xml
