#include "framework/record/record_plugin/row_check.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/core/state/contact_exchange.h"
#include "framework/record/record_plugin/stored.h"
#include "framework/scene/guide_orders.h"
#include "framework/scene/surface_settings.h"

namespace presa::record {
namespace {

/// The offending value as text, or "" when the rule holds.
std::string broken(const Rule& rule, const Column& column, const void* row) {
  if (rule.finite) {
    const auto value = valueAt<double>(row, column.offset);
    return std::isfinite(value) ? "" : std::to_string(value);
  }
  const auto outside = [&](auto value) {
    return std::cmp_less(value, rule.min) || std::cmp_greater(value, rule.max) ? std::to_string(value) : "";
  };
  switch (column.cell) {
    case Cell::kU64:
      return outside(valueAt<std::uint64_t>(row, column.offset));
    case Cell::kU32:
      return outside(valueAt<std::uint32_t>(row, column.offset));
    case Cell::kI32:
      return outside(valueAt<std::int32_t>(row, column.offset));
    case Cell::kF64:
      break;
  }
  return {};
}

std::string allowed(const Rule& rule) {
  if (rule.finite) return "a finite number";
  return rule.min == rule.max ? std::to_string(rule.min) : std::to_string(rule.min) + " to " + std::to_string(rule.max);
}

}  // namespace

std::vector<Rule> tickRules(std::uint64_t fingers) {
  const auto count = static_cast<std::int64_t>(fingers);
  return {{"device_time", 0, -1, true},
          {"command_time", 0, -1, true},
          {"object_time_end", 0, -1, true},
          {"commanded_value", 0, -1, true},
          {"surfaces_changed", 0, 1},
          {"rearms", 0, std::numeric_limits<std::uint32_t>::max()},
          {"commanded", 0, SurfaceSettings::kCapacity},
          {"device_count", count, count},
          {"command_count", count, count},
          {"stop_requested", 0, 1}};
}

std::vector<Rule> fingerRules(std::uint64_t scene_bodies) {
  return {{"phase", -1, kMaxPhases - 1},
          {"valid", 0, 3},
          {"mode", 0, static_cast<std::int64_t>(ContactMode::kSlip)},
          {"body", -1, static_cast<std::int64_t>(scene_bodies) - 1}};
}

std::vector<Rule> orderRules(std::uint64_t scene_bodies) {
  return {{"goal", TakenOrders::kUndo, std::numeric_limits<std::int32_t>::max()},
          {"body", kNoBody, static_cast<std::int64_t>(scene_bodies) - 1}};
}

std::vector<Rule> scheduleRules() { return {{"made_up", 0, 7}}; }

RowCheck::RowCheck(std::string path, const Table& table, const std::vector<Rule>& rules) : path_(std::move(path)) {
  for (const Rule& rule : rules) {
    const auto column = std::find_if(table.columns.begin(), table.columns.end(),
                                     [&](const Column& one) { return one.name == rule.column; });
    if (column != table.columns.end()) watched_.push_back({rule, *column, 0, 0, {}});
  }
}

void RowCheck::check(const void* row, std::uint64_t number) {
  for (Watched& one : watched_) {
    std::string found = broken(one.rule, one.column, row);
    if (found.empty()) continue;
    if (one.broken++ > 0) continue;
    one.first = number;
    one.found = std::move(found);
  }
}

void RowCheck::report(const std::string& file, std::uint64_t rows, Diagnostics& findings) const {
  for (const Watched& one : watched_) {
    if (one.broken == 0 || one.first >= rows) continue;
    const std::string more = one.broken > 1 ? "; " + std::to_string(one.broken - 1) + " more rows are wrong" : "";
    findings.error(675, {file, 0, 0},
                   path_ + ": column '" + one.column.name + "', row " + std::to_string(one.first) + ": found " +
                       one.found + ", allowed " + allowed(one.rule) + more,
                   "rows count from 0; was it changed since it was recorded?");
  }
}

}  // namespace presa::record
