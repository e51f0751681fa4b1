#pragma once
#include <utility>
#include <vector>

#include "modules/dynamics_ode/contact_solver/contact_problem.h"
#include "modules/dynamics_ode/contact_solver/joint_steps.h"

namespace presa::ode {

/// Iterative contact solver for heaps: the period is divided into small steps of equal length, and each does two sweeps
/// of projected Gauss-Seidel from the impulses of the one before [Macklin2019, Catto2023]. Cost is linear in contacts.
/// Collision runs once a period; gaps follow the motion of the touched points.
///
/// A small step of length h: velocities take the external forces and the last impulses; a sweep with feedback of the
/// gaps; positions advance; a sweep without feedback, which takes out again what the feedback added to velocities and
/// thus to energy. Friction is a round Coulomb cone on the normal impulse of the same sweep, rolling resistance a moment
/// of at most a length times that.
class SmallSteps {
 public:
  struct Options {
    int count = 8;  ///< per period
    /// Way of a contact around a rim within a small step [rad]: with a longer one there are more steps.
    double rim_run = 0.005;
    int max_count = 128;
    std::size_t max_wobbling = 8;  ///< bodies of an island up to which that is affordable
    double max_push = 1;           ///< maximum speed at which overlapping bodies are pushed apart [m/s]
    double stiffness = 0.7;        ///< of a contact: omega h of its spring-damper
    double damping = 5;            ///< its relative damping
    /// The same in an island that a finger touches, and the min stiffness of a contact of the touched body [N/m].
    double touched = 1.5, min_touched = 2e4;
  };
  /// Reserves memory for `bodies` and `contacts`; more allocate once.
  SmallSteps(const Options& options, std::size_t bodies, std::size_t contacts) : options_(options) {
    contacts_.reserve(contacts);
    inverse_inertia_W_.reserve(bodies);
    begin_.reserve(bodies);
    touched_.reserve(bodies);
  }
  /// Reserves memory for rolling resistance of `contacts`.
  void makeRollsRoom(std::size_t contacts) { rolls_.reserve(contacts); }
  void makeRoom(std::size_t fingers, std::size_t motors, std::size_t joints) {
    fingers_.reserve(fingers);
    motors_.reserve(motors);
    joints_.makeRoom(joints);
  }

  void solve(ContactProblem& problem, double period);

 private:
  using Body = ContactProblem::Body;
  /// One direction d of a point of contact, with r x d and the inverse inertia times that, for A and B.
  struct Axis {
    Vec3 d, rA_d, rB_d, iA, iB;
    double mass = 0;     // reduced mass along it [kg]
    double impulse = 0;  // on B [N s]
  };
  struct Row {  // of a contact or a finger
    std::int32_t A = ContactProblem::kFixed, B = 0;
    double inverse_mass_A = 0, inverse_mass_B = 0;
    Vec3 rA_W = Vec3::Zero(), rB_W = Vec3::Zero(), rA_A = Vec3::Zero(),
         rB_B = Vec3::Zero();  // lever arms at the start, in W and in the axes of the bodies
    Axis n, t1, t2;
    double mu = 0;
  };
  struct Softness {  // of a contact's spring-damper over a small step [Catto2023]
    double bias_rate = 0, mass_scale = 1, impulse_scale = 0;
  };
  struct ContactRow : Row {
    double gap_begin = 0, gap = 0, reach_begin = 0;
    Vec3 drift_W = Vec3::Zero();  // velocity at the contact that the bodies gain as they turn freely [m/s]
    const Rim *rim_A = nullptr, *rim_B = nullptr;  // null: the contact stays where it is on the body
    Softness soft;
  };
  struct FingerRow : Row {
    const FingerConstraint* constraint = nullptr;
    double depth = 0, u1 = 0, u2 = 0;  // stretch of the springs at the start of the small step [m]
    Vec3 sum_W = Vec3::Zero();         // of impulses [N s]
  };
  struct RollRow {  // rolling resistance of a contact
    std::size_t contact = 0;
    double length = 0;                                  // [m]
    Eigen::Vector2d impulse = Eigen::Vector2d::Zero();  // angular, along t1 and t2 of the contact, on B [N m s]
  };
  struct MotorRow {
    ContactProblem::Motor motor;
    double mass = 0, impulse = 0;
  };

  void prepare();
  void soften();
  Softness softnessOf(double stiffness) const;
  void connect(Row& row, const Vec3& p_W, const Vec3& nhat, const Vec3& tangent) const;
  Axis axisOf(const Row& row, const Vec3& direction) const;
  void addForces();
  void apply(const Row& row, Axis& axis, double impulse);
  void warmStart();
  double speedOf(const Row& row, const Axis& axis) const;
  void sweep(bool feedback);
  void solveContact(ContactRow& row, bool feedback);
  void turn(const RollRow& row, const Eigen::Vector2d& impulse);
  void solveRoll(RollRow& row);
  void solveFinger(FingerRow& row);
  void solveMotor(MotorRow& row);
  double springImpulse(const FingerRow& row, const Axis& axis, double k, double d, double stretch) const;
  void advance();
  Vec3 movedAt(const Row& row) const;
  void followRims(double ahead);
  double reachOf(const ContactRow& row) const;
  double gapOf(const ContactRow& row) const;
  double runOf(const Rim& rim, std::int32_t body, const Vec3& nhat_W, double period) const;
  int countFor(double period) const;
  Vec3 armAhead(ContactRow& row, const Rim& rim, std::int32_t body, double sign, double ahead) const;
  void turnInertia(std::size_t i);
  void followFingers(double time);
  void giveBack(double period);

  const Options options_;
  ContactProblem* problem_ = nullptr;
  double h_ = 0;
  std::vector<ContactRow> contacts_;
  std::vector<RollRow> rolls_;
  std::vector<FingerRow> fingers_;
  std::vector<MotorRow> motors_;
  JointSteps joints_;
  std::vector<Mat3> inverse_inertia_W_;
  std::vector<Vec3> begin_;    // centres of mass at the start
  std::vector<char> touched_;  // by body: a finger touches it
};

}  // namespace presa::ode
