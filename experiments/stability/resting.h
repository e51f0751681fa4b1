#pragma once
#include <string>
#include <vector>

#include "experiments/stability/case.h"
#include "experiments/stability/methods.h"

/// A body that fingers press against a support; it must come to rest.
namespace presa::stability {

struct Resting {
  std::string scene;
  std::vector<std::string> sets;
  std::string body;
  double force = 0;        ///< expected mean of the fingers' normal forces at rest [N]
  double force_bound = 0;  ///< of the relative force error [%]
  std::string oracle;      ///< origin of the expected force
  double duration = 3;     ///< [s]; the last second is judged
};

/// Compliance bound: rigid contacts deflect by at most h cfm / erp = 2.5 um/N (5 ms, 1e-4 m/(N s), 0.2). Returns the
/// share of `depth` that `load` takes up when a single corner carries it [%].
double yieldBound(double load, double depth);

/// Runs and judges the speed of the fastest point of the body and the force error over the last second.
std::vector<Finding> settle(const Resting& resting, DeviceList fingers);

/// Trials for 1, 10 and 100 g under fingers of 0.5, 2 and 10 N/mm, with each method.
std::vector<Trial> restingTrials(
    const std::function<std::vector<Finding>(double mass, double stiffness, const Method&)>& run);

}  // namespace presa::stability
