#include "apps/studies/stability/overview.h"

#include <algorithm>
#include <cmath>

#include "apps/common/report/svg_plot.h"
#include "apps/common/terminal/text.h"
#include "apps/studies/stability/tally.h"

namespace presa::stability {
namespace {

using svg::escape;
using terminal::format;

/// A column of the grid: methods that answer the same question.
struct Family {
  std::string title;
  std::vector<std::string> methods;  ///< empty: every method that no other family has; its cells name them
  bool has(const std::string& method) const {
    return std::find(methods.begin(), methods.end(), method) != methods.end();
  }
};

const std::vector<Family>& families() {
  static const std::vector<Family> kFamilies{
      {"Presa", {kPresa}},
      {"explicit coupling", {"explicit coupling"}},
      {"20 iterations", {"20 iterations"}},
      {"pyramid friction", {"pyramid friction"}},
      {"other rotation", {"engine's rotation", "no gyroscopic term", "one Euler step", "R (I + S dt)"}},
      {"other renderers", {"penalty", "scp", "intermediate", "fca_mesh"}},
      {"of one case alone", {}},
  };
  return kFamilies;
}

std::size_t familyOf(const std::string& method) {
  const std::vector<Family>& all = families();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Family& f) { return f.has(method); });
  return found == all.end() ? all.size() - 1 : static_cast<std::size_t>(found - all.begin());
}

std::vector<bool> familiesOf(const std::vector<Row>& rows) {
  std::vector<bool> present(families().size(), false);
  for (const Row& row : rows) present[familyOf(row.method)] = true;
  return present;
}

/// Largest share of a bound that Presa's results reach, in percent.
std::string largestShare(const std::vector<const Row*>& rows) {
  double largest = 0;
  for (const Row* row : rows) {
    if (row->method != kPresa || !(row->finding.bound > 0)) continue;
    largest = std::max(largest, std::abs(row->finding.value) / row->finding.bound);
  }
  if (!std::isfinite(largest)) return "no number";
  return largest < 1e-3  ? "&lt; 0.1 %"
         : largest < 0.1 ? format("%.1f %%", 100 * largest)
                         : format("%.0f %%", 100 * largest);
}

std::string gridCell(std::size_t family, const std::vector<const Row*>& rows) {
  Tally tally;
  std::vector<std::string> names;
  for (const Row* row : rows) {
    if (familyOf(row->method) != family) continue;
    tally.add(*row);
    if (std::find(names.begin(), names.end(), row->method) == names.end()) names.push_back(row->method);
  }
  if (tally.all == 0) return "<td class=\"none\"></td>";
  std::string out = std::string("<td class=\"fill ") + cssOf(tally.worst) + (tally.worse > 0 ? " worse" : "") +
                    "\" data-family=\"" + escape(families()[family].title) + "\"><span class=\"count\">" +
                    signHtml(tally.worst) + format(" %zu/%zu", tally.stable, tally.all) +
                    (tally.worse > 0 ? " " + worseSignHtml() : "") + "</span>";
  if (!families()[family].methods.empty()) return out + "</td>";
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return out + " <small>" + escape(list) + "</small></td>";
}

}  // namespace

std::string overviewHtml(const std::vector<Case>& cases, const std::vector<Row>& rows) {
  const std::vector<bool> present = familiesOf(rows);
  std::string out = "<div class=\"scroll\"><table class=\"overview\"><thead><tr><th scope=\"col\">case</th>";
  for (std::size_t i = 0; i < present.size(); ++i) {
    if (present[i]) out += "<th scope=\"col\">" + escape(families()[i].title) + "</th>";
  }
  out += "<th scope=\"col\">share of bound</th></tr></thead><tbody>\n";
  for (const Case& c : cases) {
    const std::vector<const Row*> own = rowsOfCase(c, rows);
    if (own.empty()) continue;
    out += "<tr data-case=\"" + escape(c.name) + "\"><th scope=\"row\"><a href=\"#" + escape(c.name) + "\">" +
           escape(c.title) + "</a></th>";
    for (std::size_t i = 0; i < present.size(); ++i) {
      if (present[i]) out += gridCell(i, own);
    }
    out += "<td class=\"share\" data-family=\"share of bound\">" + largestShare(own) + "</td></tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

}  // namespace presa::stability
