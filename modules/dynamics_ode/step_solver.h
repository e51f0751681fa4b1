#pragma once
#include <vector>

#include "modules/dynamics_ode/contact_joints.h"
#include "modules/dynamics_ode/finger_joints.h"
#include "modules/dynamics_ode/island_solver.h"

namespace presa::ode {

/// Solves one step with ODE's solvers and Coulomb friction between bodies: a round cone over the normal force of the
/// same step, opposing the slip. ODE alone bounds friction by a box, and in its direct solver by the normal force of a
/// solve without friction.
///
/// A contact starts from the direction and normal force of the last step. Where something slid, the island is first
/// solved without friction, and friction is aligned against the predicted slip. After the solve each island is checked;
/// one with a contact outside its cone, or sliding well inside it, is restored and solved once more with the forces
/// just found.
class StepSolver {
 public:
  StepSolver(const Scene& scene, Engine& engine, BodySet& bodies, const OdeOptions& options);

  /// Steps all bodies from the start of the step. `layers`: stack height (`Layers`, `kAllLayers`). True when an island
  /// fell back to the iterative solver.
  bool solve(const std::vector<BodyContact>& contacts, FingerJoints& fingers, Islands& islands, int layers, double h,
             int substeps);

  struct Counts {
    std::uint64_t predictions = 0, repeats = 0;  // number of islands
  } counts;

 private:
  void pass(FingerJoints& fingers, Islands& islands, const std::vector<char>& wanted, double h, bool friction);
  /// The contacts of one pair of bodies.
  struct Patch {
    std::size_t body = 0;  // B
    std::size_t first = 0, end = 0;
    double friction = 0, cone = 0, limit = 0;  // sums over the contacts [N]; limit: the imposed bound
  };
  struct Load {
    double all = 0, sliding = 0;
  };
  template <class Use>
  void forEachPatch(Use use);
  double slipOf(const Patch& patch) const;
  void soften(double h);
  void startFromLastStep();
  void boundByNormalForce(Islands& islands);
  std::size_t islandOf(std::size_t i, Islands& islands) const {
    return islands.of(static_cast<std::size_t>(joints_.contact(i).B));
  }
  bool findSliding(Islands& islands);
  void predict(FingerJoints& fingers, Islands& islands, const std::vector<char>& wanted, double h);
  bool judge(Islands& islands);
  void putBack(Islands& islands, const std::vector<char>& wanted);

  Engine& engine_;
  BodySet& bodies_;
  const OdeOptions options_;
  IslandSolver solver_;
  ContactJoints joints_;
  std::vector<char> all_, sliding_, wrong_, fell_back_;  // by island
  std::vector<Load> load_;                               // by island
  int iterations_ = 0;
};

}  // namespace presa::ode
