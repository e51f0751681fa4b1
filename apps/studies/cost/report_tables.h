#pragma once
#include <string>

#include "apps/studies/cost/result.h"

/// The tables of the report, as HTML; empty where a study has nothing to show.
namespace presa::cost {

/// What one knob buys, per metric.
std::string gains(const Result& result);
/// The cheapest setting below each just-noticeable difference, and below all.
std::string choice(const Result& result);
/// How far the default is from each front.
std::string frontDistances(const Result& result);
/// Every setting with its errors and costs.
std::string settings(const Result& result);
/// The decimated meshes.
std::string meshes(const Result& result);

}  // namespace presa::cost
