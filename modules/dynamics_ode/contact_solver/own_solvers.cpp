#include "modules/dynamics_ode/contact_solver/own_solvers.h"

#include <algorithm>
#include <numeric>

#include "framework/geometry/index.h"
#include "modules/dynamics_ode/contact_solver/joined_pair.h"
#include "modules/dynamics_ode/contact_solver/one_axis.h"

namespace presa::ode {
namespace {

constexpr std::size_t kAnyWork = static_cast<std::size_t>(-1);
// rows of contacts for which the small steps reserve memory; more allocate once
constexpr std::size_t kMostRows = 8192;
// within a step, of a body on its rim, up to which its contact counts as staying where it is [rad]
constexpr double kMaxRimTurn = 1e-3;

// No bound on the cost when the scene asks for Newton's method.
NewtonSolver::Options newtonOptions(const OdeOptions& options) {
  NewtonSolver::Options newton = options.newton;
  if (options.method.solver == DynamicsSettings::Solver::kNewton) newton.max_products = kAnyWork;
  return newton;
}

}  // namespace

OwnSolvers::OwnSolvers(const Scene& scene, const Vec3& gravity_W, BodySet& bodies, const OdeOptions& options)
    : bodies_(bodies),
      options_(options),
      gravity_W_(gravity_W),
      newton_(newtonOptions(options), bodies.size(), bodies.contactRoom()),
      small_steps_(options.small_steps, bodies.size(), std::min(kMostRows, bodies.contactRoom())),
      joints_(scene, options, bodies.contactRoom()),
      place_(bodies.size(), ContactProblem::kFixed),
      back_off_(bodies.size()) {
  const std::size_t contacts = bodies.contactRoom();
  const auto bounces = [](const Material& material) { return material.restitution > 0; };
  if (std::ranges::any_of(scene.materials, bounces)) bounce_.emplace(bodies.size(), contacts);
  if (std::ranges::any_of(scene.materials, [](const Material& material) { return material.rolling > 0; })) {
    newton_.makeRollsRoom(contacts);
    small_steps_.makeRollsRoom(std::min(kMostRows, contacts));
  }
  problem_.bodies.reserve(bodies.size());
  problem_.contacts.reserve(contacts);
  for (Members* members : {&members_, &contacts_, &fingers_, &motors_, &links_})
    members->first.reserve(bodies.size() + 2);
  members_.items.reserve(bodies.size());
  contacts_.items.reserve(contacts);
}

void OwnSolvers::makeRoom(std::size_t finger_contacts, std::size_t joints) {
  const std::size_t motors = finger_contacts + 6 * bodies_.size();  // six axes of a snap drive
  problem_.fingers.reserve(finger_contacts);
  problem_.motors.reserve(motors);
  all_motors_.reserve(motors);
  fingers_.items.reserve(finger_contacts);
  motors_.items.reserve(motors);
  problem_.joints.reserve(joints);
  links_.items.reserve(joints);
  newton_.makeRoom(finger_contacts, motors, joints);
  small_steps_.makeRoom(finger_contacts, motors, joints);
}

// Counting sort; items whose island is `islands` or more belong to none.
template <class IslandOf>
void OwnSolvers::Members::sort(std::size_t count, std::size_t islands, IslandOf island_of) {
  first.assign(islands + 2, 0);
  items.resize(count);
  if (count == 0) return;
  for (std::size_t i = 0; i < count; ++i) ++first[std::min(island_of(i), islands) + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  for (std::size_t i = 0; i < count; ++i) items[first[std::min(island_of(i), islands)]++] = i;
  std::rotate(first.begin(), first.end() - 1, first.end());
  first[0] = 0;
}

// Filled in place: a copy of what was just written number by number would wait for that.
void OwnSolvers::addBody(std::size_t i) {
  place_[i] = static_cast<std::int32_t>(problem_.bodies.size());
  ContactProblem::Body& body = problem_.bodies.emplace_back();
  const BodySet::Motion motion = bodies_.motion(i);
  body.p_WCm = motion.p_WCm;
  body.v_WCm = motion.v_WCm;
  body.w_WB = motion.w_WB;
  body.q_WB = motion.q_WB;
  const BodySet::Load load = bodies_.load(i, gravity_W_);
  body.mass = load.mass;
  body.inertia_B = load.inertia;
  body.inverse_inertia_B = load.inverse_inertia;
  body.force_W = load.force_W;
  body.torque_W = load.torque_W;
}

void OwnSolvers::gather(std::size_t island, const FingerJoints& fingers, const JointSet* links) {
  problem_.clear();
  for (std::size_t k = members_.first[island]; k < members_.first[island + 1]; ++k) {
    addBody(members_.items[k]);
  }
  for (std::size_t k = contacts_.first[island]; k < contacts_.first[island + 1]; ++k) {
    const BodyContact& c = joints_.contact(contacts_.items[k]);
    const ContactJoints::Joint& joint = joints_[contacts_.items[k]];
    problem_.contacts.push_back({place_[index(c.A)], place_[index(c.B)], c.p_W, c.nhat_AB_W, -c.depth, joint.mu,
                                 joint.rolling, joint.restitution, joint.f_B_W, joint.m_B_W,
                                 rimAt(bodies_, index(c.A), c, c.nhat_AB_W),
                                 rimAt(bodies_, index(c.B), c, -c.nhat_AB_W)});
  }
  for (std::size_t k = fingers_.first[island]; k < fingers_.first[island + 1]; ++k) {
    const std::size_t i = fingers_.items[k];
    if (!fingers.areForces()) problem_.fingers.push_back({place_[fingers.body(i)], &fingers.row(i), Vec3::Zero()});
  }
  for (std::size_t k = motors_.first[island]; k < motors_.first[island + 1]; ++k) {
    problem_.motors.push_back(all_motors_[motors_.items[k]]);
    problem_.motors.back().body = place_[index(problem_.motors.back().body)];
  }
  if (links == nullptr) return;
  for (std::size_t k = links_.first[island]; k < links_.first[island + 1]; ++k) {
    const std::size_t i = links_.items[k];
    const Joint& joint = links->joint(i);
    const std::int32_t A = joint.to == Joint::kWorld ? ContactProblem::kFixed : place_[joint.to];
    problem_.joints.push_back(links->problemOf(i, bodies_, A, place_[joint.body]));
  }
}

bool OwnSolvers::isRough(std::size_t island) const {
  for (std::size_t k = members_.first[island]; k < members_.first[island + 1]; ++k) {
    if (back_off_[members_.items[k]].steps > 0) return true;
  }
  return false;
}

// Newton's method takes contacts to be where they were at the start of the step.
bool OwnSolvers::wobbles(double h) const {
  if (problem_.bodies.size() > options_.small_steps.max_wobbling || !problem_.fingers.empty()) return false;
  const auto turns = [&](const Rim& rim, std::int32_t body) {
    return rim && h * problem_.bodies[index(body)].w_WB.norm() > kMaxRimTurn;
  };
  return std::any_of(problem_.contacts.begin(), problem_.contacts.end(),
                     [&](const ContactProblem::Contact& c) { return turns(c.rim_A, c.A) || turns(c.rim_B, c.B); });
}

void OwnSolvers::backOff(std::size_t island) {
  int steps = kMinBackOff;
  for (std::size_t k = members_.first[island]; k < members_.first[island + 1]; ++k) {
    steps = std::max(steps, back_off_[members_.items[k]].next);
  }
  for (std::size_t k = members_.first[island]; k < members_.first[island + 1]; ++k) {
    back_off_[members_.items[k]] = {steps, std::min(2 * steps, kMaxBackOff)};
  }
}

void OwnSolvers::forgive(std::size_t island) {
  for (std::size_t k = members_.first[island]; k < members_.first[island + 1]; ++k) {
    int& next = back_off_[members_.items[k]].next;
    next = std::max(next - 1, kMinBackOff);
  }
}

void OwnSolvers::solveProblem(std::size_t island, double h) {
  using Solver = DynamicsSettings::Solver;
  const Solver solver = options_.method.solver;
  if (solver != Solver::kSmallSteps && (stepOnAxis(problem_, h) || stepJoinedPair(problem_, h))) {
    ++counts.single_joints;
    return;
  }
  const std::size_t max_work = solver == Solver::kNewton ? kAnyWork : options_.newton_work;
  if (solver != Solver::kSmallSteps && !isRough(island) && !wobbles(h) && newton_.analyse(problem_, max_work)) {
    if (newton_.solve(problem_, h)) {
      ++counts.newton;
      forgive(island);
      return;
    }
    backOff(island);
  }
  ++counts.small_steps;
  small_steps_.solve(problem_, h);
}

void OwnSolvers::giveBack(std::size_t island, FingerJoints& fingers, JointSet* links) {
  for (std::size_t k = members_.first[island]; k < members_.first[island + 1]; ++k) {
    const std::size_t i = members_.items[k];
    const ContactProblem::Body& body = problem_.bodies[index(place_[i])];
    bodies_.setMotion(i, {body.p_WCm, body.v_WCm, body.w_WB, body.q_WB});
    place_[i] = ContactProblem::kFixed;
    if (back_off_[i].steps > 0) --back_off_[i].steps;
  }
  for (std::size_t k = 0; k < problem_.contacts.size(); ++k) {
    ContactJoints::Joint& joint = joints_[contacts_.items[contacts_.first[island] + k]];
    joint.f_B_W = problem_.contacts[k].f_B_W;
    joint.m_B_W = problem_.contacts[k].m_B_W;
  }
  for (std::size_t k = 0; k < problem_.joints.size(); ++k) {
    links->keep(links_.items[links_.first[island] + k], problem_.joints[k], problem_.joints.size() == 1);
  }
  for (std::size_t k = 0; k < problem_.fingers.size(); ++k) {
    fingers.setForce(fingers_.items[fingers_.first[island] + k], problem_.fingers[k].f_B_W);
  }
}

void OwnSolvers::solve(const std::vector<BodyContact>& contacts, FingerJoints& fingers,
                       const std::vector<ContactProblem::Motor>* motors, JointSet* links, Islands& islands, double h) {
  joints_.begin(contacts, bodies_, h);
  all_motors_.assign(fingers.motors().begin(), fingers.motors().end());
  if (motors != nullptr) all_motors_.insert(all_motors_.end(), motors->begin(), motors->end());
  const std::size_t count = bodies_.size();
  const auto of = [&](std::size_t body) { return bodies_.awake(body) ? islands.of(body) : count; };
  members_.sort(count, count, of);
  contacts_.sort(joints_.size(), count, [&](std::size_t i) { return of(index(joints_.contact(i).B)); });
  fingers_.sort(fingers.count(), count, [&](std::size_t i) { return of(fingers.body(i)); });
  motors_.sort(all_motors_.size(), count, [&](std::size_t i) { return of(index(all_motors_[i].body)); });
  if (links != nullptr) {
    links_.sort(links->size(), count, [&](std::size_t i) {
      const std::size_t body = links->movingBody(i, bodies_);
      return body < count ? of(body) : count;
    });
  }
  for (std::size_t island = 0; island < count; ++island) {
    if (members_.first[island] == members_.first[island + 1]) continue;
    gather(island, fingers, links);
    if (bounce_) bounce_->before(problem_, h);
    solveProblem(island, h);
    if (bounce_) bounce_->after(problem_);
    giveBack(island, fingers, links);
  }
  joints_.end(bodies_);
}

}  // namespace presa::ode
