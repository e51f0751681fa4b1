#pragma once
#include <string>
#include <vector>

#include "apps/studies/cost/study.h"

namespace presa::cost {

/// What the command line says.
struct Request {
  std::string input{};  ///< a scene, or a study file
  std::string rig{};
  std::vector<std::string> sets{}, knobs{}, metrics{};
  std::string out{};       ///< folder; empty: cost_NAME
  double duration = 0;     ///< 0: as the study says, else to the end of the script
  std::uint64_t seed = 0;  ///< 0: as the study says, else 1
  bool quick = false;
};

/// The study asked for, checked: every finding at once. Unusable when `diagnostics` has errors. Runs nothing.
Study planStudy(const Request& request, Diagnostics& diagnostics);

/// Where the results go, from the request and the study's name.
void chooseFolder(const Request& request, Study& study);

/// Reads a study file into `study`: all but settings. Its knob grids are returned.
std::vector<std::vector<Knob>> readStudyFile(const std::string& file, const Request& request, Study& study,
                                             Diagnostics& diagnostics);

/// Whether the file's root element says that it is a study.
bool isStudyFile(const std::string& file);

}  // namespace presa::cost
