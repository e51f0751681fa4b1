#include "framework/scene/xml/value_rule.h"

#include <libxml/tree.h>
#include <libxml/xmlregexp.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <memory>

#include "framework/core/diagnostics/diagnostics.h"

namespace presa::xml {
namespace {

constexpr const char* kWhiteSpace = " \t\r\n";
enum ValueCode { kWrongKind = 116, kOutOfRange = 117, kWrongCount = 118 };

const xmlChar* toXml(const std::string& text) { return reinterpret_cast<const xmlChar*>(text.c_str()); }

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(kWhiteSpace);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kWhiteSpace) - first + 1);
}

bool inRange(const ValueRule& rule, double value) {
  if (rule.min && (rule.min->included ? value < rule.min->value : value <= rule.min->value)) return false;
  if (rule.max && (rule.max->included ? value > rule.max->value : value >= rule.max->value)) return false;
  return true;
}

std::string rangeText(const ValueRule& rule) {
  if (rule.min && rule.max) {
    return std::string(" in ") + (rule.min->included ? "[" : "(") + numberText(rule.min->value) + ", " +
           numberText(rule.max->value) + (rule.max->included ? "]" : ")");
  }
  if (rule.min) return (rule.min->included ? " >= " : " > ") + numberText(rule.min->value);
  if (rule.max) return (rule.max->included ? " <= " : " < ") + numberText(rule.max->value);
  return {};
}

std::string listText(const std::vector<std::string>& parts) {
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0) text += i + 1 == parts.size() ? " or " : ", ";
    text += parts[i];
  }
  return text;
}

/// Help for the two most common mistakes in a number: a decimal comma and a unit.
std::string numberHelp(const std::string& word) {
  const auto comma = word.find(',');
  if (comma != std::string::npos) {
    std::string with_point = word;
    with_point[comma] = '.';
    double value = 0;
    if (readNumber(with_point, value) == NumberKind::kFinite) return "the decimal sign is a point: " + with_point;
    return "numbers are separated by spaces, without commas";
  }
  const auto unit = word.find_first_not_of("+-.0123456789");
  double value = 0;
  if (unit != std::string::npos && unit > 0 && readNumber(word.substr(0, unit), value) == NumberKind::kFinite) {
    return "write the number without a unit; units are fixed (SI)";
  }
  return {};
}

std::optional<ValueProblem> numberProblem(const ValueRule& rule, const std::string& value) {
  const std::vector<std::string> words = splitWords(value);
  const std::string must = "must be " + describe(rule) + ", found ";
  if (rule.count == 1 && words.size() > 1)
    return ValueProblem{kWrongKind, must + quote(value),
                        "write one number, without a unit: SI units count (m, kg, s, N)"};
  const std::string within = rule.count != 1 ? " in " + quote(value) : "";
  for (const std::string& word : words) {
    double number = 0;
    const NumberKind kind = readNumber(word, number);
    if (kind == NumberKind::kNotANumber) return ValueProblem{kWrongKind, must + quote(word) + within, numberHelp(word)};
    if (kind == NumberKind::kNotFinite) {
      return ValueProblem{kOutOfRange, must + quote(word) + within, "the number must be finite"};
    }
    if (!inRange(rule, number)) return ValueProblem{kOutOfRange, must + quote(word) + within, {}};
  }
  if (rule.count == 0 ? !words.empty() : words.size() == rule.count) return std::nullopt;
  if (rule.count == 1) return ValueProblem{kWrongKind, must + quote(value), {}};  // empty
  return ValueProblem{kWrongCount, must + std::to_string(words.size()) + within, {}};
}

bool matchesPattern(const std::string& pattern, const std::string& value) {
  const std::unique_ptr<xmlRegexp, decltype(&xmlRegFreeRegexp)> regexp(xmlRegexpCompile(toXml(pattern)),
                                                                       &xmlRegFreeRegexp);
  return regexp && xmlRegexpExec(regexp.get(), toXml(value)) == 1;
}

bool fits(const ValueRule& rule, const std::string& value) {
  switch (rule.kind) {
    case ValueRule::Kind::kName:
      return xmlValidateNCName(toXml(value), 0) == 0;
    case ValueRule::Kind::kPattern:
      return matchesPattern(rule.pattern, value);
    case ValueRule::Kind::kBoolean:
      return value == "true" || value == "false" || value == "1" || value == "0";
    case ValueRule::Kind::kWord:
      return std::find(rule.words.begin(), rule.words.end(), value) != rule.words.end();
    default:
      return value.size() >= rule.min_length;
  }
}

}  // namespace

std::vector<std::string> splitWords(const std::string& text) {
  std::vector<std::string> words;
  std::size_t end = 0;
  for (auto first = text.find_first_not_of(kWhiteSpace); first != std::string::npos;
       first = text.find_first_not_of(kWhiteSpace, end)) {
    end = std::min(text.find_first_of(kWhiteSpace, first), text.size());
    words.push_back(text.substr(first, end - first));
  }
  return words;
}

std::string numberText(double value) {
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

NumberKind readNumber(std::string_view text, double& value) {
  text = trimmed(text);
  if (!text.empty() && text.front() == '+') {
    text.remove_prefix(1);
    if (!text.empty() && text.front() == '-') return NumberKind::kNotANumber;
  }
  double result = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), result);
  if (end != text.data() + text.size() || error == std::errc::invalid_argument) return NumberKind::kNotANumber;
  if (error == std::errc::result_out_of_range || !std::isfinite(result)) return NumberKind::kNotFinite;
  value = result;
  return NumberKind::kFinite;
}

std::string describe(const ValueRule& rule) {
  if (!rule.alternatives.empty()) {
    std::vector<std::string> parts;
    for (const ValueRule& alternative : rule.alternatives) parts.push_back(describe(alternative));
    return listText(parts);
  }
  switch (rule.kind) {
    case ValueRule::Kind::kName:
      return "a name (a letter or _, then letters, digits, _ - .)";
    case ValueRule::Kind::kPattern:
      return rule.documentation;
    case ValueRule::Kind::kBoolean:
      return "'true' or 'false'";
    case ValueRule::Kind::kNumber:
      return (rule.count == 1   ? "a number"
              : rule.count == 0 ? "one or more numbers"
                                : std::to_string(rule.count) + " numbers") +
             rangeText(rule);
    case ValueRule::Kind::kWord: {
      std::vector<std::string> parts;
      for (const std::string& word : rule.words) parts.push_back(quote(word));
      return listText(parts);
    }
    default:
      return rule.min_length > 0 ? "a text that is not empty" : "a text";
  }
}

std::optional<ValueProblem> problemOf(const ValueRule& rule, const std::string& value) {
  if (!rule.alternatives.empty()) {
    std::optional<ValueProblem> problem;
    for (const ValueRule& alternative : rule.alternatives) {
      const auto alternative_problem = problemOf(alternative, value);
      if (!alternative_problem) return std::nullopt;
      if (!problem || alternative_problem->code == kOutOfRange) problem = alternative_problem;
    }
    problem->message = "must be " + describe(rule) + ", found " + quote(value);
    return problem;
  }
  if (rule.kind == ValueRule::Kind::kNumber) return numberProblem(rule, value);
  if (fits(rule, value)) return std::nullopt;
  return ValueProblem{
      kWrongKind, "must be " + describe(rule) + ", found " + quote(value) + didYouMean(value, rule.words), {}};
}

}  // namespace presa::xml
