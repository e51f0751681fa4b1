#pragma once
#include <optional>
#include <string>

#include "apps/common/grasp_figures.h"
#include "apps/common/run_result.h"

/// Parts of the report as HTML, every name escaped.
namespace presa::html {

std::string graspTiles(const GraspFigures& grasp);
std::string graspTable(const RunResult& result, const GraspFigures& grasp);
std::string contactTable(const RunResult& result);
std::string toolTable(const RunResult& result);
std::string objectTable(const RunResult& result);
std::string rateTable(const RunResult& result);
std::string faultsAndNotes(const RunResult& result);
std::string provenance(const RunResult& result);

}  // namespace presa::html
