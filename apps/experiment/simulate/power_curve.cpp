#include "apps/experiment/simulate/power_curve.h"

#include <algorithm>
#include <cmath>

#include "apps/common/report/svg_facets.h"
#include "apps/common/report/svg_plot.h"
#include "apps/common/report/svg_symbols.h"
#include "apps/common/terminal/text.h"
#include "apps/common/wilson.h"

namespace presa::experiment {
namespace {

using terminal::format;

constexpr std::size_t kColors = 6;  // of svg_facets.h, each with its own symbol

/// The symbol of a drawn curve: the list of the tests is the legend of the figure.
std::string symbolOf(std::size_t curve) {
  if (curve >= kColors) return {};
  const int color = static_cast<int>(curve);
  return "<svg width=\"14\" height=\"12\" aria-hidden=\"true\"><path class=\"symbol " + svg::colorClass(color) +
         "\" d=\"" + svg::symbolPath(6, 6, 4, color) + "\"/></svg> ";
}

std::string verdict(const std::vector<PowerCurve>& curves, int subjects, double wanted) {
  std::size_t good = 0;
  std::string lines;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const PowerCurve& curve = curves[i];
    const PowerCurve::Point& last = curve.points.back();
    const int enough = curve.reached(wanted);
    good += enough > 0 ? 1 : 0;
    lines += "<li>" + symbolOf(i) + svg::escape(curve.test) +
             format(": power %.2f (%.2f to %.2f) with %d subjects", last.power, last.low, last.high, last.subjects) +
             (enough == 0         ? std::string("; that is too few")
              : enough < subjects ? format("; %d %s enough", enough, enough == 1 ? "is" : "are")
                                  : std::string()) +
             ".</li>\n";
  }
  return std::string("<div class=\"verdict ") + (good == curves.size() ? "good" : "bad") + "\"><b>" +
         (good == curves.size()
              ? format("%d subjects give a power of %.2g in every test", subjects, wanted)
              : format("%d subjects give a power of %.2g in %zu of %zu tests", subjects, wanted, good, curves.size())) +
         "</b>\n<ul>\n" + lines + "</ul></div>\n";
}

}  // namespace

int PowerCurve::reached(double wanted) const {
  int found = 0;
  for (auto point = points.rbegin(); point != points.rend() && point->power >= wanted; ++point) found = point->subjects;
  return found;
}

std::vector<int> curveSizes(int subjects) {
  const int count = std::min(subjects, 6);
  std::vector<int> sizes;
  for (int i = 1; i <= count; ++i) sizes.push_back(static_cast<int>(std::lround(double(i) * subjects / count)));
  return sizes;
}

PowerCurve::Point powerPoint(int subjects, std::size_t significant, std::size_t studies) {
  const Share power = shareOf(significant, studies);
  return {subjects, power.value, power.low, power.high};
}

std::string powerFigure(const std::vector<PowerCurve>& curves, int subjects, double wanted) {
  if (curves.empty()) return "<p class=\"empty\">The analysis has no test: no number is a probability.</p>\n";
  using Kind = svg::Layer::Kind;
  svg::FacetFigure figure;
  figure.title = "Power over the number of subjects";
  figure.x_label = "subjects";
  figure.y_label = "power: share of the studies with p < 0.05";
  figure.y_max = 1;
  figure.x_from_zero = true;
  for (const int n : curveSizes(subjects)) figure.x_ticks.push_back(n);
  svg::Facet facet;
  const auto line = [&](double x0, double y0, double x1, double y1, const std::string& label) {
    facet.layers.push_back({Kind::kLine, -1, true, {{x0, y0}, {x1, y1}}});
    figure.legend.push_back({label, Kind::kLine, -1, true});
  };
  for (std::size_t i = 0; i < curves.size() && i < kColors; ++i) {
    svg::Layer layer{Kind::kJoined, static_cast<int>(i)};
    for (const PowerCurve::Point& point : curves[i].points) {
      svg::FacetPoint at{static_cast<double>(point.subjects), point.power, point.low, point.high};
      at.label = curves[i].test + format("\n%d subjects: power %.2f\n95 %% interval %.2f to %.2f", point.subjects,
                                         point.power, point.low, point.high);
      layer.points.push_back(at);
    }
    svg::Layer band{Kind::kArea, static_cast<int>(i), false, layer.points};
    for (svg::FacetPoint& point : layer.points) point.low = point.high = svg::FacetPoint::kNone;
    facet.layers.push_back(band);
    facet.layers.push_back(layer);
  }
  line(0, wanted, subjects, wanted, format("wanted: %.2g", wanted));
  line(subjects, 0, subjects, 1, format("planned: %d", subjects));
  figure.facets.push_back(facet);
  std::string left_out;
  if (curves.size() > kColors)
    left_out = format(" Not drawn: %zu more tests, see power_curve.csv.", curves.size() - kColors);
  return verdict(curves, subjects, wanted) + "<figure><h2>Power over the number of subjects</h2>\n" +
         svg::render(figure) +
         "<figcaption class=\"caption\">Each point analyses the first subjects of every study. Bands: 95 % interval "
         "from "
         "the number of studies." +
         left_out + "</figcaption></figure>\n";
}

std::string powerCurveCsv(const std::vector<PowerCurve>& curves) {
  std::string text = "subjects,test,power,low,high\n";
  for (const PowerCurve& curve : curves) {
    for (const PowerCurve::Point& point : curve.points)
      text +=
          format("%d,\"%s\",%.9g,%.9g,%.9g\n", point.subjects, curve.test.c_str(), point.power, point.low, point.high);
  }
  return text;
}

}  // namespace presa::experiment
