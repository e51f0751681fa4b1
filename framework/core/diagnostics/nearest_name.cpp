#include <algorithm>
#include <cctype>

#include "framework/core/diagnostics/diagnostics.h"

namespace presa {
namespace {

std::string lowerCase(std::string word) {
  for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return word;
}

std::size_t allowedDistance(std::size_t length) { return length < 6 ? 1 : 1 + (length - 3) / 3; }

/// Number of insertions, deletions, replacements and swaps of neighbours that turn a into b (optimal string alignment).
std::size_t editDistance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replace = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, replace});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
    before_last.swap(last);
    last.swap(row);
  }
  return last[b.size()];
}

}  // namespace

std::string nearestName(const std::string& word, const std::vector<std::string>& candidates) {
  const std::string lower = lowerCase(word);
  std::string nearest;
  std::size_t nearest_distance = word.size() + 1;
  for (const std::string& candidate : candidates) {
    const auto [shorter, longer] = std::minmax({word.size(), candidate.size()});
    const std::size_t allowed = allowedDistance(longer);
    if (longer - shorter > allowed) continue;  // also skips very long words, which would be expensive
    const std::size_t distance = editDistance(lower, lowerCase(candidate));
    // a word without one correct letter is no typing error
    if (distance > allowed || distance >= longer || distance >= nearest_distance) continue;
    nearest = candidate;
    nearest_distance = distance;
  }
  return nearest;
}

std::string didYouMean(const std::string& word, const std::vector<std::string>& candidates) {
  const std::string nearest = nearestName(word, candidates);
  return nearest.empty() ? "" : " (did you mean '" + nearest + "'?)";
}

}  // namespace presa
