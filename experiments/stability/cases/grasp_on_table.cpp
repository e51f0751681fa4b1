#include "experiments/stability/cases.h"
#include "experiments/stability/fingers.h"
#include "experiments/stability/resting.h"

namespace presa::stability::grasp_on_table {
namespace {

std::vector<Finding> hold(double mass, double stiffness, const Method& method) {
  const std::vector<std::string> sets{"body/cube/physics/mass=" + number(mass),
                                      "material/skin/stiffness=" + number(stiffness)};
  Pinch pinch;
  pinch.center = {0.0001, 0, 0.040};  // off the centre of the cube, and above it
  pinch.width = 0.07;
  pinch.depth = 0.002;
  const double force = stiffness * pinch.depth;
  return settle({.scene = "grasp_on_table.xml",
                 .sets = sets + method,
                 .body = "cube",
                 .force = force,
                 .force_bound = 0.1,
                 .oracle = "the fingers' mean is k depth = " + number(force) + " N, wherever the cube stands"},
                pinchFingers(pinch));
}

}  // namespace

Case make() {
  Case result;
  result.name = "grasp_on_table";
  result.title = "Two fingers hold a cube that stands on a table";
  result.source =
      "The grasp of a light body on a rigid floor, where iterative solvers fail first: springs and rigid contacts "
      "act on one body.";
  result.oracle = "The cube stands still, and the fingers press with k times their depth.";
  result.scene = "grasp_on_table.xml";
  result.trials = restingTrials(hold);
  return result;
}

}  // namespace presa::stability::grasp_on_table
