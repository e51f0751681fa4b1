#pragma once
#include <optional>
#include <string>
#include <vector>

#include "apps/studies/cost/front.h"

/// Analysis of a study's results beside its front: gain per factor, sentences.
namespace presa::cost {

/// Effect of changing one factor from its default to another value.
struct FactorGain {
  std::string factor, from, to;
  double cost_ratio = 1;   ///< ratio of processor time
  double error_ratio = 1;  ///< below 1: more accurate
  /// Extrapolated error ratio for twice the cost along this factor; no value when the cost does not change measurably.
  std::optional<double> per_double_cost;
};
/// Of every factor but conditions.
std::vector<FactorGain> factorGains(const Result& result, const std::string& metric);

/// The sentences at the end of the report: at most one per rule.
std::vector<std::string> sentences(const Result& result);

/// What beats the default, and by how much, such as "no dearer at 0.45 times the error is coupling explicit".
std::string whatBeats(const Result& result, const FrontDistance& distance);

/// The number that a text is; no value for other texts.
std::optional<double> numberIn(const std::string& text);

/// A title within a sentence: its first letter small.
std::string lowered(std::string title);

/// The sets as options to paste into a shell: "--set rates/dynamics=100".
std::string setOptions(const std::vector<std::string>& sets);

/// The value that the setting has for a factor; empty: it has none.
std::string valueOf(const Setting& setting, const std::string& factor);

/// Number and unit, such as "0.0123 N".
std::string withUnit(double value, const std::string& unit);

}  // namespace presa::cost
