#include "apps/common/report/svg_save.h"

#include <cctype>
#include <cmath>
#include <map>
#include <sstream>

#include "apps/common/number_text.h"
#include "apps/common/replace_all.h"
#include "apps/common/report/base64.h"
#include "apps/common/report/page.h"
#include "apps/common/report/svg_plot.h"

namespace presa::svg {
namespace {

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

/// The colours of the page's first block, which is the light one: "--ink" -> "#1b1f24".
std::map<std::string, std::string> lightColors(const std::string& style) {
  std::map<std::string, std::string> colors;
  const std::size_t end = style.find('}');
  for (std::size_t at = style.find("--"); at < end; at = style.find("--", at + 2)) {
    const std::size_t colon = style.find(':', at), semicolon = style.find(';', colon);
    if (semicolon == std::string::npos || semicolon > end) break;
    colors[style.substr(at, colon - at)] =
        style.substr(style.find_first_not_of(' ', colon + 1), semicolon - style.find_first_not_of(' ', colon + 1));
  }
  return colors;
}

/// The page's rules for plots, without variables.
std::string plotRules() {
  const std::string style = page::style();
  std::string rules;
  std::istringstream lines(style);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("svg ")) rules += line + "\n";
  }
  replaceAll(rules, "--fill:", "color:");
  replaceAll(rules, "var(--fill)", "currentColor");
  for (const auto& [name, color] : lightColors(style)) replaceAll(rules, "var(" + name + ")", color);
  return rules;
}

std::string fileName(const std::string& title) {
  constexpr std::size_t kLongest = 60;
  std::string name;
  for (const char c : title) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (plain) name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (!plain && !name.empty() && name.back() != '-') name += '-';
    if (name.size() == kLongest) break;
  }
  while (!name.empty() && name.back() == '-') name.pop_back();
  return name.empty() ? "figure" : name;
}

}  // namespace

Csv::Csv(const std::vector<std::string>& headings) {
  for (const std::string& heading : headings) text_ += (text_.empty() ? "" : ",") + quoted(heading);
  text_ += "\n";
}

void Csv::row(const std::vector<double>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i > 0) text_ += ',';
    if (std::isfinite(values[i])) text_ += significant(values[i], 7);
  }
  text_ += "\n";
}

void Csv::row(const std::string& name, const std::vector<double>& values) {
  text_ += quoted(name) + ",";
  row(values);
}

std::string standalone(const std::string& svg_element) {
  static const std::string rules = plotRules();
  constexpr std::size_t kOpening = 5;  // "<svg "
  const std::size_t inside = svg_element.find('>') + 1;
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" " + svg_element.substr(kOpening, inside - kOpening) + "<style>\n" +
         rules + "</style><rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>" + svg_element.substr(inside);
}

std::string withSaveLinks(const std::string& css_class, const std::string& svg_element, const std::string& more,
                          const std::string& title, const Csv& csv) {
  const auto link = [&](const std::string& ending, const std::string& type, const std::string& bytes) {
    return "<a download=\"" + fileName(title) + "." + ending + "\" href=\"data:" + type + ";base64," + base64(bytes) +
           "\">" + (ending == "svg" ? "SVG" : "CSV") + "</a>";
  };
  return "<div class=\"" + css_class + "\">" + svg_element + more + "</div>\n<p class=\"save\">Save as " +
         link("svg", "image/svg+xml", standalone(svg_element)) + " or " + link("csv", "text/csv", csv.text()) +
         "</p>\n";
}

}  // namespace presa::svg
