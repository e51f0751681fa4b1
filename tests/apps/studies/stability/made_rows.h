#pragma once
#include <cmath>
#include <string>
#include <vector>

#include "apps/studies/stability/rows.h"

namespace presa::stability::test {

/// Cases and rows as a whole run has them: long titles, references that change with the parameters, curves, and more
/// methods than a page is wide.
struct MadeRows {
  std::vector<Case> cases;
  std::vector<Row> rows;
};

inline const std::vector<std::string>& madeMethods() {
  static const std::vector<std::string> kMethods{
      kPresa, "explicit coupling",  "20 iterations", "engine's rotation", "R (I + S dt)", "pyramid friction", "penalty",
      "scp",  "force one tick late"};
  return kMethods;
}

inline Curve madeCurve(double amplitude) {
  Curve curve{"force on the finger", {}, {}};
  for (int i = 0; i < 200; ++i) {
    curve.x.push_back(0.01 * i);
    curve.y.push_back(amplitude * std::sin(0.1 * i));
  }
  return curve;
}

/// Presa's rows are stable, those of the others unstable, as expected.
inline MadeRows madeRows(int cases) {
  MadeRows made;
  for (int i = 0; i < cases; ++i) {
    Case c;
    c.name = "case_" + std::to_string(i);
    c.title = "Ten minutes of grabbing, throwing & groping number " + std::to_string(i) + ", one minute per seed";
    c.oracle = "The force of each finger is its stiffness times its depth, and the body stays where it is.";
    c.source = "A closed form.";
    c.scene = "grasp_in_air.xml";
    for (const std::string& method : madeMethods()) {
      for (const char* mass : {"1 g", "20 g", "500 g"}) {
        for (const char* metric : {"grip force error", "offset of the object in the hand"}) {
          const bool own = method == kPresa;
          Row row;
          row.case_name = c.name;
          row.parameters = {{"mass", mass}, {"stiffness", "10 N/mm"}, {"direction of the shaking", "(0.5, 0.87, 0)"}};
          row.method = method;
          row.finding = finding(metric, own ? 0.5 : 123456, "mm/s", 1,
                                metric[0] == 'g' ? "k depth = 20 N" : "the closed form for " + std::string(mass));
          row.expected = own ? Verdict::kStable : Verdict::kUnstable;
          row.finding.plot_x = "time [s]";
          row.finding.plot_y = "force [N]";
          row.finding.curves = {madeCurve(own ? 1 : 50)};
          made.rows.push_back(row);
        }
      }
    }
    made.cases.push_back(std::move(c));
  }
  return made;
}

}  // namespace presa::stability::test
