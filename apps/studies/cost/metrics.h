#pragma once
#include <string>
#include <vector>

#include "apps/studies/cost/metric.h"

namespace presa::cost {

/// Presa's own metrics, which a study computes that names none.
const std::vector<Metric>& ownMetrics();
/// The metric of that name, Presa's own or that of a plug-in, which this loads; null if there is none. The address stays
/// valid. Thread: main. Throws InputError when the plug-in cannot be loaded.
const Metric* findMetric(const std::string& name);
/// Names of all metrics: Presa's own, then those of plug-ins, none of which this loads.
std::vector<std::string> metricNames();

}  // namespace presa::cost
