#pragma once
#include <optional>
#include <vector>

#include "modules/dynamics_ode/body_set.h"
#include "modules/dynamics_ode/contact_joints.h"
#include "modules/dynamics_ode/contact_solver/bounce.h"
#include "modules/dynamics_ode/contact_solver/newton_solver.h"
#include "modules/dynamics_ode/contact_solver/small_steps.h"
#include "modules/dynamics_ode/finger_joints.h"
#include "modules/dynamics_ode/islands.h"
#include "modules/dynamics_ode/joints/joint_set.h"
#include "modules/dynamics_ode/ode_options.h"

namespace presa::ode {

/// Steps islands with Presa's own solvers: by Newton's method where its factorisation is cheap, as in chains and small
/// groups; large heaps in small steps. After Newton's method has not converged on an island, its bodies are solved in
/// small steps for a while, which doubles with every failure and shrinks with every success.
class OwnSolvers {
 public:
  OwnSolvers(const Scene& scene, const Vec3& gravity_W, BodySet& bodies, const OdeOptions& options);

  /// Reserves memory for the contacts of fingers, for motors and for joints.
  void makeRoom(std::size_t finger_contacts, std::size_t joints);
  /// Steps all awake bodies over `h` [s]. Reads and writes the forces of `fingers`. `motors` may be null; their bodies
  /// are indices into the scene. `links` may be null; its positions have been read.
  void solve(const std::vector<BodyContact>& contacts, FingerJoints& fingers,
             const std::vector<ContactProblem::Motor>* motors, JointSet* links, Islands& islands, double h);

  static constexpr int kMinBackOff = 20, kMaxBackOff = 640;  // steps
  struct Counts {
    std::uint64_t single_joints = 0, newton = 0, small_steps = 0;  ///< islands solved
  } counts;
  const NewtonSolver::Counts& newtonCounts() const noexcept { return newton_.counts; }

 private:
  /// The members of each island, as runs of `items`.
  struct Members {
    std::vector<std::size_t> items, first;
    template <class IslandOf>
    void sort(std::size_t count, std::size_t islands, IslandOf island_of);
  };
  void gather(std::size_t island, const FingerJoints& fingers, const JointSet* links);
  void solveProblem(std::size_t island, double h);
  void giveBack(std::size_t island, FingerJoints& fingers, JointSet* links);
  void addBody(std::size_t i);
  bool isRough(std::size_t island) const;
  bool wobbles(double h) const;
  void backOff(std::size_t island);
  void forgive(std::size_t island);

  BodySet& bodies_;
  const OdeOptions options_;
  const Vec3 gravity_W_;
  NewtonSolver newton_;
  SmallSteps small_steps_;
  std::optional<Bounce> bounce_;  // empty where no material bounces
  ContactJoints joints_;
  std::vector<ContactProblem::Motor> all_motors_;
  ContactProblem problem_;
  Members members_, contacts_, fingers_, motors_, links_;  // by island
  std::vector<std::int32_t> place_;                        // by body: its index in the problem, kFixed: none
  struct BackOff {
    int steps = 0;           // for which Newton's method is not tried
    int next = kMinBackOff;  // steps after the next failure
  };
  std::vector<BackOff> back_off_;  // by body
};

}  // namespace presa::ode
