#include "apps/studies/cost/condition_factor.h"

#include <algorithm>
#include <charconv>

#include "apps/common/terminal/text.h"
#include "framework/scene/manifest.h"

namespace presa::cost {
namespace {

constexpr std::string_view kLatency = "run/latency";

struct KnownJitter {
  std::string_view path;
  Jitter Conditions::*jitter;
};
constexpr KnownJitter kJitters[] = {{"run/haptic_jitter", &Conditions::haptic},
                                    {"run/collision_jitter", &Conditions::collision},
                                    {"run/dynamics_jitter", &Conditions::dynamics}};

bool isCondition(const std::string& set) { return set.starts_with("run/"); }

std::vector<std::string> conditionPaths() {
  std::vector<std::string> paths{std::string(kLatency)};
  for (const KnownJitter& known : kJitters) paths.emplace_back(known.path);
  return paths;
}

/// Reads a text that is a number within [low, high].
template <class Value>
bool readWithin(std::string_view text, Value low, Value high, Value& value) {
  const auto [rest, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  return status == std::errc{} && rest == text.data() + text.size() && value >= low && value <= high;
}

/// Reads SHARE or SHARE:PERIODS.
bool readJitter(std::string_view text, Jitter& jitter) {
  const std::size_t colon = std::min(text.find(':'), text.size());
  const bool periods = colon == text.size() || readWithin(text.substr(colon + 1), 1, 100, jitter.periods);
  return readWithin(text.substr(0, colon), 0.0, 1.0, jitter.share) && periods;
}

void read(const std::string& set, Conditions& conditions, Diagnostics& diagnostics) {
  const std::size_t equals = std::min(set.find('='), set.size());
  const std::string path = set.substr(0, equals), text = set.substr(std::min(equals + 1, set.size()));
  const SourceLocation where{set, 0, 0};
  if (path == kLatency) {
    if (!readWithin(text, 0.0, 1.0, conditions.latency))
      diagnostics.error(802, where, "a latency is a time from 0 to 1 s, found " + quote(text), "for example 0.01");
    return;
  }
  const auto known = std::ranges::find(kJitters, path, &KnownJitter::path);
  if (known == std::end(kJitters)) {
    std::string list;
    for (const std::string& each : conditionPaths()) list += (list.empty() ? "" : ", ") + each;
    diagnostics.error(801, where, "there is no condition " + quote(path) + didYouMean(path, conditionPaths()),
                      "conditions of a run: " + list);
  } else if (!readJitter(text, conditions.*known->jitter)) {
    diagnostics.error(802, where, "jitter is a share of late wake-ups from 0 to 1, found " + quote(text),
                      "for example 0.1, or 0.1:3: after 3 periods instead of one (1 to 100; default 2, haptic 5)");
  }
}

}  // namespace

Conditions takeConditions(std::vector<std::string>& sets, Diagnostics& diagnostics) {
  Conditions conditions;
  for (const std::string& set : sets) {
    if (isCondition(set)) read(set, conditions, diagnostics);
  }
  for (const KnownJitter& known : kJitters) {
    Jitter& jitter = conditions.*known.jitter;
    if (jitter.share == 0 || jitter.periods == 1) jitter = Conditions{}.*known.jitter;  // no tick is late
  }
  std::erase_if(sets, isCondition);
  return conditions;
}

void refuseConditions(std::vector<std::string>& sets, const SourceLocation& where, Diagnostics& diagnostics) {
  for (const std::string& set : sets) {
    if (isCondition(set))
      diagnostics.error(802, where, quote(set) + " is a condition of the run, and no value of the scene",
                        "conditions are knobs, beside a run without: --knob latency=0,0.01");
  }
  std::erase_if(sets, isCondition);
}

bool hasConditions(const Setting& setting) {
  std::vector<std::string> sets = setting.sets;
  Diagnostics ignored;
  return takeConditions(sets, ignored) != Conditions{};
}

std::string toText(const Conditions& conditions) {
  std::string text = terminal::format("latency %.17g", conditions.latency);
  for (const KnownJitter& known : kJitters) {
    const Jitter& jitter = conditions.*known.jitter;
    text += terminal::format(", %.17g:%d", jitter.share, jitter.periods);
  }
  return text;
}

}  // namespace presa::cost
