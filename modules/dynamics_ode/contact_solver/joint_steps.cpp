#include "modules/dynamics_ode/contact_solver/joint_steps.h"

#include <algorithm>
#include <cmath>

#include "framework/geometry/index.h"

namespace presa::ode {
namespace {

// Sweeps over joints alone, until no impulse changes the energy by more than this part of what the largest does: stops
// and locked directions of a door share its inertia, and an impact that they disagreed about would come back.
constexpr std::size_t kMinRepeats = 4, kMaxRepeats = 40, kMaxSolves = 1500;  // of rows
constexpr double kSettles = 1e-6;

}  // namespace

void JointSteps::begin() {
  rows_.clear();
  steps_.clear();
  end_.clear();
}

void JointSteps::connect(const std::vector<Mat3>& inverse_inertia_W, const AxisRow& row, Step& step) const {
  step.compliance = 1 / row.k;
  const auto respond = [&](std::int32_t i, const AxisRow::Vec6& J, AxisRow::Vec6& response) {
    if (i == ContactProblem::kFixed) return;
    response << J.head<3>() / problem_->bodies[index(i)].mass, inverse_inertia_W[index(i)] * J.tail<3>();
    step.compliance += J.dot(response);
  };
  respond(row.A, row.J_A, step.response_A);
  respond(row.B, row.J_B, step.response_B);
}

void JointSteps::apply(const AxisRow& row, const Step& step, double impulse) {
  const auto push = [&](std::int32_t i, const AxisRow::Vec6& response) {
    if (i == ContactProblem::kFixed) return;
    problem_->bodies[index(i)].v_WCm += impulse * response.head<3>();
    problem_->bodies[index(i)].w_WB += impulse * response.tail<3>();
  };
  push(row.A, step.response_A);
  push(row.B, step.response_B);
}

void JointSteps::beginStep(ContactProblem& problem, const std::vector<Mat3>& inverse_inertia_W, double h) {
  problem_ = &problem;
  rows_.clear();
  end_.clear();
  for (ContactProblem::Joint& joint : problem.joints) {
    followPosition(problem, joint);
    const std::size_t first = rows_.size();
    const std::size_t locked =
        appendRows(problem, joint, centreOf(problem, joint.A), centreOf(problem, joint.B), h, rows_).count;
    steps_.resize(std::max(steps_.size(), rows_.size()));
    for (std::size_t i = first; i < rows_.size(); ++i) {
      steps_[i].locked = i < first + locked;
      connect(inverse_inertia_W, rows_[i], steps_[i]);
    }
    end_.push_back(rows_.size());
  }
  for (std::size_t i = 0; i < rows_.size(); ++i) apply(rows_[i], steps_[i], steps_[i].impulse);
}

// Returns the change of the impulse.
double JointSteps::solve(std::size_t i, bool feedback) {
  const AxisRow& row = rows_[i];
  Step& step = steps_[i];
  double u = 0, goal = row.goal;
  for (const auto& [body, J] : {std::pair(row.A, &row.J_A), std::pair(row.B, &row.J_B)}) {
    if (body == ContactProblem::kFixed) continue;
    u += J->head<3>().dot(problem_->bodies[index(body)].v_WCm) + J->tail<3>().dot(problem_->bodies[index(body)].w_WB);
  }
  if (!feedback) {
    if (step.locked) goal = 0;
    if (row.low == 0) goal = std::min(goal, 0.0);  // a stop that was passed
    if (row.high == 0) goal = std::max(goal, 0.0);
  }
  const double wanted = step.impulse + (goal - u - step.impulse / row.k) / step.compliance;
  const double impulse = row.clamped(wanted);
  const double change = impulse - step.impulse;
  apply(row, step, change);
  step.impulse = impulse;
  return change;
}

void JointSteps::sweep(bool feedback) {
  const std::size_t repeats = std::clamp(kMaxSolves / std::max<std::size_t>(1, rows_.size()), kMinRepeats, kMaxRepeats);
  for (std::size_t n = 0; n < repeats; ++n) {
    double change = 0, moves = 0;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const std::size_t row = feedback ? i : rows_.size() - 1 - i;
      const double dp = solve(row, feedback), compliance = steps_[row].compliance;
      change = std::max(change, dp * dp * compliance);
      moves = std::max(moves, steps_[row].impulse * steps_[row].impulse * compliance);
    }
    if (change <= kSettles * moves) break;
  }
}

void JointSteps::giveBack(double h) {
  std::size_t i = 0;
  for (std::size_t j = 0; j < end_.size(); ++j) {
    ContactProblem::Joint& joint = problem_->joints[j];
    joint.f_B_W = joint.m_B_W = Vec3::Zero();
    joint.lead = {};
    for (; i < end_[j]; ++i) addLoad(rows_[i], steps_[i].impulse / h, joint);
  }
}

}  // namespace presa::ode
