#pragma once
#include <cstdint>
#include <utility>
#include <vector>

#include "modules/dynamics_ode/contact_solver/joint_rows.h"
#include "modules/dynamics_ode/contact_solver/newton_rows.h"

namespace presa::ode {

/// Direct contact solver for islands of any size whose bodies form chains rather than heaps: one implicit step as a
/// convex minimisation over the velocities v at its end,
///   min 1/2 (v - v*)^T M (v - v*) + sum of the potentials of contacts, fingers and motors,
/// solved by Newton's method with a sparse factorisation [Castro2022]. v* are the velocities without any contact.
///
/// A contact is a stiff spring-damper along its normal; along its tangents a stiff spring whose state is the friction of
/// the last step, so that nothing creeps, inside a round Coulomb cone. The cone stands on the normal impulse of the
/// minimisation before. A gap counts as a spring that starts at its end. Rolling resistance is a stiff rotational damper
/// with a moment of at most a length times that impulse.
///
/// Joints (joint_rows.h) act along their directions at the start of the step, and close at its end: SHAKE, symplectic and
/// of second order with velocities at half steps [Ryckaert1977, Hairer2006]. A pendulum keeps its energy.
class NewtonSolver {
 public:
  struct Options {
    /// Of a contact: 1 / (reduced mass * stiffness * step^2), before damping. Under a light body that a finger presses
    /// the contact is harder: its compliance is at most max_compliance [m/(N s)].
    double softness = 2e-4;
    double max_compliance = 1e-4;
    double erp = 0.2;                 ///< fraction of an overlap removed per step
    double max_push = 1;              ///< maximum speed at which overlapping bodies are pushed apart [m/s]
    std::size_t max_iterations = 40;  ///< of one minimisation
    std::size_t max_products = 8000;  ///< the same, in products of blocks; at least kMinIterations
    int max_cones = 10;               ///< minimisations, each on the cones of the one before
  };
  static constexpr std::size_t kMinIterations = 8;

  /// Reserves memory for `bodies` and `contacts` in all.
  NewtonSolver(const Options& options, std::size_t bodies, std::size_t contacts);

  /// Reserves memory for rolling resistance of `contacts`.
  void makeRollsRoom(std::size_t contacts) { rolls_.reserve(contacts); }
  void makeRoom(std::size_t fingers, std::size_t motors, std::size_t joints) {
    rows_.reserve(pairs_.capacity() + fingers);
    pairs_.reserve(pairs_.capacity() + joints);
    axes_.reserve(motors + kMaxJointRows * joints);
    locked_.reserve(joints);
    ends_.reserve(joints > 0 ? mass_.capacity() : 0);
    if (joints == 0) return;
    for (std::vector<Mat3>* of : {&turning_, &own_inertia_W_}) of->reserve(mass_.capacity());
    free_turn_.reserve(mass_.capacity());
    turned_.reserve(kMaxJointRows);
  }
  /// Takes the pattern of `problem`. False when an iteration would take more than `max_work` products of 6 x 6 blocks,
  /// or the problem has more than BlockCholesky::kMaxCount bodies.
  bool analyse(const ContactProblem& problem, std::size_t max_work);
  /// Solves the analysed problem for a step of `h` [s]. False when it did not converge: `problem` is then unchanged.
  bool solve(ContactProblem& problem, double h);

  struct Counts {
    std::uint64_t solves = 0, iterations = 0, failures = 0;
  } counts;

 private:
  using Vec6 = newton::Vec6;
  using Vector = newton::Vector;
  using Row = newton::Row;

  void makeMasses(const ContactProblem& problem, double h);
  void sumTurning(const ContactProblem& problem);
  bool mayTurnFast(const ContactProblem& problem, double h) const;
  bool stiffenTurns(double h);
  void makeRows(const ContactProblem& problem, double h);
  void addContact(const ContactProblem& problem, const ContactProblem::Contact& contact, double h);
  void addFinger(const ContactProblem& problem, const ContactProblem::Finger& finger, double h);
  void addRoll(const ContactProblem& problem, const ContactProblem::Contact& contact, const Mat3& R);
  void addMotor(const ContactProblem& problem, const ContactProblem::Motor& motor, double h);
  void addJoint(const ContactProblem& problem, const ContactProblem::Joint& joint, double h);
  /// Whether anything but locked directions of joints acts.
  bool hasBounds() const noexcept;
  bool aimJoints(const ContactProblem& problem, double h);
  double missOf(const ContactProblem& problem, double h);
  void moveGoals();
  struct End {
    Pose X_WCm;  // of the centre of mass, with the body's axes
    Vec3 w_WB;   // [rad/s]
  };
  End endOf(const ContactProblem::Body& body, const Vec6& v, double h) const;
  Pose poseAtEnd(std::int32_t i) const;
  bool turnJoints(const ContactProblem& problem, double h);
  void giveBackJoints(ContactProblem& problem, double h) const;
  void assembleAxis(const AxisRow& row);
  Vec6 massTimes(std::size_t body, const Vec6& v) const;
  double valueAt(const Vector& v) const;
  double slopeAt(double alpha, const Vector& v, const Vector& dv, double& curvature) const;
  double lineSearch(const Vector& v, const Vector& dv) const;
  void newtonStep();
  bool assemble(newton::Response (*respond)(const Row&, const Vec3&));
  void assembleRoll(const newton::Roll& roll);
  double limitOf(const newton::Roll& roll) const { return roll.length * rows_[roll.row].normal; }
  bool guess();
  bool arrived() const noexcept;
  bool minimise();
  double standCones();
  void giveBack(ContactProblem& problem, double h) const;

  Options options_;
  BlockCholesky matrix_;
  std::vector<BlockCholesky::Pair> pairs_;
  std::vector<Row> rows_;            // contacts, then fingers
  std::vector<newton::Roll> rolls_;  // of contacts with rolling resistance
  std::vector<AxisRow> axes_;        // motors, then the rows of each joint
  struct Locked {                    // rows of a joint's locked directions, from `first`, and of its axes, to `end`
    std::size_t first = 0, count = 0, end = 0;
    JointGap begin;
    std::array<double, kMaxLocked> miss{};
  };
  std::vector<Locked> locked_;  // as the joints of the problem
  std::vector<End> ends_;       // by body, with joints: where v_ leads in the step
  bool ends_stand_ = false;     // ends_ are those of v_
  std::vector<double> mass_;
  std::vector<Mat3> inertia_W_;
  bool is_stiff_ = false;            // joints act along their directions at the end of this step
  std::vector<Mat3> turning_;        // by body, with joints: h^2 stiffness that their forces give its rotation
  std::vector<Mat3> own_inertia_W_;  // without that stiffness, in a stiff step
  std::vector<Vec3> free_turn_;      // the same: angular velocities without any contact
  std::vector<AxisRow> turned_;      // rows of one joint at the end of the step
  Vector free_, v_, gradient_, step_, other_;  // free_: v*
};

}  // namespace presa::ode
