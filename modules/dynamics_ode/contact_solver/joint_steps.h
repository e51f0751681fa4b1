#pragma once
#include <vector>

#include "modules/dynamics_ode/contact_solver/joint_rows.h"

namespace presa::ode {

/// The joints of a problem in small steps of projected Gauss-Seidel (small_steps.h): rows anew from where the bodies are
/// at the start of every small step, impulses from the one before.
class JointSteps {
 public:
  void makeRoom(std::size_t joints) {
    rows_.reserve(kMaxJointRows * joints);
    steps_.reserve(kMaxJointRows * joints);
    end_.reserve(joints);
  }
  /// Starts a period.
  void begin();
  /// Starts a small step of `h` [s]: takes the rows and applies the impulses of the one before to the velocities.
  void beginStep(ContactProblem& problem, const std::vector<Mat3>& inverse_inertia_W, double h);
  /// Sweeps over the rows, some tens of times until they agree. Without `feedback` locked directions stop moving, but
  /// close no gap.
  void sweep(bool feedback);
  /// Writes the forces of the last small step, of `h` [s], to the joints.
  void giveBack(double h);

 private:
  struct Step {
    AxisRow::Vec6 response_A, response_B;  // velocities by a unit impulse
    double compliance = 0, impulse = 0;    // of the row and of the bodies together [1/kg]
    bool locked = false;
  };
  void connect(const std::vector<Mat3>& inverse_inertia_W, const AxisRow& row, Step& step) const;
  void apply(const AxisRow& row, const Step& step, double impulse);
  double solve(std::size_t i, bool feedback);

  ContactProblem* problem_ = nullptr;
  std::vector<AxisRow> rows_;
  std::vector<Step> steps_;       // as rows
  std::vector<std::size_t> end_;  // by joint: of its rows
};

}  // namespace presa::ode
