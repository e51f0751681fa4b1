#pragma once
#include <string>
#include <vector>

#include "experiments/stability/case.h"
#include "experiments/stability/methods.h"

/// A body that fingers press against something: it must come to rest.
namespace presa::stability {

struct Resting {
  std::string scene;
  std::vector<std::string> sets;
  std::string body;
  double force = 0;        ///< mean of the fingers' normal forces once at rest [N]
  double force_bound = 0;  ///< of its error [%]
  std::string oracle;      ///< where the force comes from
  double duration = 3;     ///< the last second is judged [s]
};

/// Rigid contacts give way by h cfm / erp = 2.5 um/N at most (5 ms, 1e-4 m/(N s), 0.2): how much of `depth` a load takes up
/// when a single corner carries it [%].
double yieldBound(double load, double depth);

/// Speed of the fastest point of the body and error of the force, over the last second.
std::vector<Finding> settle(const Resting& resting, DeviceList fingers);

/// 1, 10 and 100 g under fingers of 0.5, 2 and 10 N/mm, with each method.
std::vector<Trial> restingTrials(
    const std::function<std::vector<Finding>(double mass, double stiffness, const Method&)>& run);

}  // namespace presa::stability
