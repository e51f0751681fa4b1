#include <cmath>

#include "apps/common/delimited.h"
#include "apps/common/report/html.h"
#include "apps/common/report/svg_plot.h"
#include "apps/common/terminal/text.h"
#include "apps/experiment/analysis/section.h"
#include "framework/scene/xml/value_rule.h"

namespace presa::experiment::analysis {
namespace {

using statistics::Interval;

/// Shortest text that reads back as the same number.
std::string exact(double value) { return std::isfinite(value) ? xml::numberText(value) : "n/a"; }

Json numberOrNull(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

bool holdsIntervals(const Table& table, std::size_t column) {
  for (const auto& row : table.rows) {
    if (std::holds_alternative<Interval>(row[column])) return true;
  }
  return false;
}

Json jsonOf(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  if (const auto* number = std::get_if<double>(&cell)) return numberOrNull(*number);
  if (const auto* interval = std::get_if<Interval>(&cell))
    return {{"low", numberOrNull(interval->low)}, {"high", numberOrNull(interval->high)}};
  return nullptr;
}

Json jsonOf(const Table& table) {
  Json json{{"table", table.id}, {"units", Json::object()}, {"rows", Json::array()}};
  for (const Table::Column& column : table.columns) {
    if (!column.unit.empty()) json["units"][column.name] = column.unit;
  }
  for (const auto& row : table.rows) {
    Json one = Json::object();
    for (std::size_t c = 0; c < row.size(); ++c) one[table.columns[c].name] = jsonOf(row[c]);
    json["rows"].push_back(std::move(one));
  }
  return json;
}

/// Column heading; a long name may break at its underscores.
std::string headOf(const Table::Column& column) {
  std::string out;
  for (const char c : svg::escape(headingOf(column.name, column.unit)))
    out += c == '_' ? std::string("_<wbr>") : std::string(1, c);
  return out;
}

std::string csvCell(const Cell& cell, bool interval) {
  if (const auto* text = std::get_if<std::string>(&cell)) return quotedCell(*text, ',');
  if (const auto* number = std::get_if<double>(&cell)) return exact(*number);
  if (const auto* both = std::get_if<Interval>(&cell)) return exact(both->low) + "," + exact(both->high);
  return interval ? "n/a,n/a" : "n/a";
}

std::string htmlCell(const Cell& cell, const std::string& format) {
  if (const auto* text = std::get_if<std::string>(&cell)) return svg::escape(*text);
  if (const auto* number = std::get_if<double>(&cell)) return svg::escape(numberText(*number, format));
  if (const auto* interval = std::get_if<Interval>(&cell)) return svg::escape(intervalText(*interval, format));
  return "–";
}

}  // namespace

std::string numberText(double value, const std::string& format) {
  if (std::isnan(value)) return "–";
  if (std::isinf(value)) return value > 0 ? "∞" : "−∞";
  if (format == "p") return value < 1e-4 ? "< 0.0001" : terminal::format("%.4f", value);
  char text[64];
  std::snprintf(text, sizeof text, format.c_str(), value);
  std::string out = text;
  if (out.starts_with('-'))
    out = out.find_first_of("123456789") == std::string::npos ? out.substr(1) : "−" + out.substr(1);
  return out;
}

std::string intervalText(const Interval& interval, const std::string& format) {
  return numberText(interval.low, format) + " to " + numberText(interval.high, format);
}

std::string csvOf(const Table& table) {
  std::string text;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const auto& [name, unit, format] = table.columns[c];
    if (c > 0) text += ",";
    text += holdsIntervals(table, c) ? headingOf(name + "_low", unit) + "," + headingOf(name + "_high", unit)
                                     : headingOf(name, unit);
  }
  text += "\n";
  for (const auto& row : table.rows) {
    for (std::size_t c = 0; c < row.size(); ++c) text += (c > 0 ? "," : "") + csvCell(row[c], holdsIntervals(table, c));
    text += "\n";
  }
  return text;
}

Json jsonOf(const Section& section) {
  Json json{{"kind", section.kind},       {"title", section.title}, {"method", section.method},
            {"finding", section.finding}, {"notes", section.notes}, {"tables", Json::array()}};
  for (const Table& table : section.tables) json["tables"].push_back(jsonOf(table));
  return json;
}

std::string htmlOf(const Table& table) {
  std::vector<std::string> head;
  for (const Table::Column& column : table.columns) head.push_back(headOf(column));
  std::string rows;
  for (const auto& row : table.rows) {
    std::vector<std::string> cells;
    for (std::size_t c = 0; c < row.size(); ++c) cells.push_back(htmlCell(row[c], table.columns[c].format));
    rows += html::row(cells);
  }
  const std::string text = html::table(head, rows);
  if (!table.folded) return text;
  return "<details><summary>" + std::to_string(table.rows.size()) + " rows</summary>\n" + text + "</details>\n";
}

std::string Context::unitOf(const std::string& name) const {
  for (const Variable& variable : variablesOf(experiment)) {
    if (variable.name == name) return variable.unit == "1" ? "" : variable.unit;
  }
  return {};
}

std::string Context::heading(const std::string& name) const { return headingOf(name, unitOf(name)); }

std::string Context::percent() const { return terminal::format("%.4g %%", 100 * confidence()); }

void noteIncomplete(const Context& context, const std::vector<std::string>& names, Section& section) {
  const std::size_t without = context.trials.size() - context.trials.complete(names).size();
  if (without == 0) return;
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  section.notes.push_back(std::to_string(without) + (without == 1 ? " trial is" : " trials are") +
                          " left out here for want of one of these: " + list + ".");
}

}  // namespace presa::experiment::analysis
