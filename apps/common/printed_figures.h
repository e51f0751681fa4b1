#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "framework/core/diagnostics/diagnostics.h"

/// What a paper prints about the system of a scene (config/schema/printed.xsd). Thread: main.
namespace presa {

struct PrintedFigure {
  std::string what, where;    ///< "natural frequency of the grasp", section of the source
  std::string printed, unit;  ///< as the source has it; the unit may be empty
  std::string measure;        ///< JSON pointer into the summary of a run; empty: no run shows it
  double factor = 1;          ///< from the unit of the summary to that of the print
  std::string note;           ///< may be empty
  std::string wrong;          ///< where the print is wrong; empty: it is not known to be
};

/// Values of one scene value.
struct PrintedValues {
  std::string name, unit, path;
  std::vector<double> values;
};

/// Values to try in turn, until a run loses the object.
struct UntilLost : PrintedValues {
  std::vector<std::string> sets;  ///< PATH=VALUE, in addition
};

struct Printed {
  std::string file, source;
  std::vector<std::string> today;   ///< PATH=VALUE that replace the printed methods by the defaults
  std::vector<PrintedValues> vary;  ///< a grid
  std::optional<UntilLost> until_lost;
  std::vector<PrintedFigure> figures;
};

/// The file about the scene `…/NAME.xml` is `…/printed/NAME.xml`. None if there is no such file, or with findings.
std::optional<Printed> printedOf(const std::string& scene_file, Diagnostics& diagnostics);

/// The figure in a summary with four digits; "–" where the run does not show it.
std::string measuredText(const PrintedFigure& figure, const nlohmann::json& summary);

}  // namespace presa
