#include "experiments/stability/cases.h"
#include "experiments/stability/methods.h"
#include "experiments/stability/pile.h"

namespace presa::stability::mesh_stack {
namespace {

std::vector<Finding> stand(const Method& method) {
  Pile pile(specOf("mesh_stack.xml", method.sets, 10), "m4");
  pile.run();
  return {pile.displacement(0.01), pile.restsWithin(2)};
}

}  // namespace

Case make() {
  Case result;
  result.name = "mesh_stack";
  result.title = "Five cubes that are triangle meshes stand on each other";
  result.source =
      "Triangle meshes meet only where triangles cross: such cubes never rested, and a stack of three flew apart at 83 "
      "m/s. A convex mesh collides as a polyhedron.";
  result.oracle = "A mesh of a cube is a cube: the stack stands within 0.01 mm and sleeps within 2 s.";
  result.scene = "mesh_stack.xml";
  Trial trial;
  trial.method = kPresa;
  trial.quick = true;
  trial.run = [] { return stand(ours()); };
  result.trials.push_back(std::move(trial));
  return result;
}

}  // namespace presa::stability::mesh_stack
