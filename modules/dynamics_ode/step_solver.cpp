// Coulomb friction with a round cone on top of ODE's box friction. Per island: predict the slip direction by a solve
// without friction (only where something slid), align the friction directions with it, solve, and check every pair's
// total friction against its cone. An island that violates it is restored and solved once more, bounded by the normal
// forces just found. Invariants: a repeated solve starts from the saved state; friction of a pair exceeds its cone by
// at most kTolerance, unless the one repetition was not enough.
#include "modules/dynamics_ode/step_solver.h"

#include <algorithm>

#include "framework/geometry/index.h"

namespace presa::ode {
namespace {

// enough for a direction only
constexpr int kPredictionIterations = 20;
constexpr int kMaxRepeats = 1;
constexpr double kSlides = 1e-5;       // slip that counts as sliding in the direct solver [m/s]; iterative: kRestSpeed
constexpr double kSlidesFast = 0.01;   // slip that cannot stop within a step [m/s]
constexpr double kSlidingShare = 0.2;  // share of the friction limits of an island at which a prediction pays
constexpr double kAtLimit = 0.98;      // friction relative to its limit above which a pair may slide
constexpr double kTolerance = 0.01;    // accepted excess of friction over its cone
constexpr double kLag = 0.05;          // accepted deficit of friction caused by an outdated normal force

bool any(const std::vector<char>& flags) { return std::find(flags.begin(), flags.end(), 1) != flags.end(); }

}  // namespace

StepSolver::StepSolver(const Scene& scene, Engine& engine, BodySet& bodies, const OdeOptions& options)
    : engine_(engine),
      bodies_(bodies),
      options_(options),
      solver_(engine, bodies, options),
      joints_(scene, options, bodies.contactRoom()),
      all_(bodies.size()),
      sliding_(bodies.size()),
      wrong_(bodies.size()),
      fell_back_(bodies.size()),
      load_(bodies.size()) {}

bool StepSolver::solve(const std::vector<BodyContact>& contacts, FingerJoints& fingers, Islands& islands, int layers,
                       double h, int substeps) {
  all_.assign(bodies_.size(), 1);
  iterations_ = solver_.iterations(contacts.size(), layers, substeps);
  joints_.begin(contacts, bodies_, h);
  soften(h);
  const bool isotropic = options_.method.friction == DynamicsSettings::Friction::kIsotropic && !contacts.empty();
  if (isotropic) startFromLastStep();
  if (isotropic && findSliding(islands)) predict(fingers, islands, sliding_, h);
  pass(fingers, islands, all_, h, true);
  if (fingers.stickToSlip(islands, wrong_)) {
    putBack(islands, wrong_);
    pass(fingers, islands, wrong_, h, true);
  }
  if (!isotropic) return any(fell_back_);
  joints_.readForces(islands, all_);
  for (int repeat = 0; repeat < kMaxRepeats && judge(islands); ++repeat) {
    putBack(islands, wrong_);
    boundByNormalForce(islands);
    predict(fingers, islands, wrong_, h);
    pass(fingers, islands, wrong_, h, true);
    joints_.readForces(islands, wrong_);
  }
  joints_.end(bodies_);
  return any(fell_back_);
}

void StepSolver::boundByNormalForce(Islands& islands) {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const double f_n = joints_[i].f_B_W.dot(joints_.contact(i).nhat_AB_W);
    const std::size_t island = islandOf(i, islands);
    if (wrong_[island] != 0) joints_[i].limit = f_n > 0 ? joints_[i].mu * f_n : fell_back_[island] != 0 ? 0 : -1;
  }
}

void StepSolver::pass(FingerJoints& fingers, Islands& islands, const std::vector<char>& wanted, double h,
                      bool friction) {
  joints_.addTo(engine_, bodies_, islands, wanted, friction);
  fingers.addTo(engine_, bodies_, islands, wanted);
  solver_.solve(islands, wanted, h, friction ? iterations_ : std::min(iterations_, kPredictionIterations), fell_back_);
  engine_.clearContacts();
}

void StepSolver::soften(double h) {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const BodyContact& c = joints_.contact(i);
    const double softness = solver_.isDirect() ? options_.direct_softness : options_.contact_softness;
    const double inverse_mass = bodies_.inverseMass(index(c.A)) + bodies_.inverseMass(index(c.B));
    joints_[i].cfm = std::min(h * softness * inverse_mass, options_.max_contact_cfm);
  }
}

// Warm start: aligns friction with the last step's load, so that a contact at its limit gives way in the right
// direction.
void StepSolver::startFromLastStep() {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    ContactJoints::Joint& joint = joints_[i];
    const Vec3& nhat = joints_.contact(i).nhat_AB_W;
    const double f_n = joint.f_B_W.dot(nhat);
    joint.direction = frictionDirection(nhat, joint.f_B_W - f_n * nhat);
    if (f_n > 0 && solver_.isDirect()) joint.limit = joint.mu * f_n;
  }
}

// A sticking pair may distribute its load arbitrarily over its contacts, and a single one may be at its limit; sliding
// is therefore judged for the pair as a whole.
template <class Use>
void StepSolver::forEachPatch(Use use) {
  for (std::size_t i = 0; i < joints_.size();) {
    const std::int32_t A = joints_.contact(i).A, B = joints_.contact(i).B;
    Patch patch{index(B), i};
    for (; i < joints_.size() && joints_.contact(i).A == A && joints_.contact(i).B == B; ++i) {
      const ContactJoints::Joint& joint = joints_[i];
      const Vec3& nhat = joints_.contact(i).nhat_AB_W;
      const double f_n = joint.f_B_W.dot(nhat);
      patch.friction += (joint.f_B_W - f_n * nhat).norm();
      patch.cone += joint.mu * f_n;
      patch.limit += joint.limit < 0 ? 1e300 : joint.limit;
    }
    patch.end = i;
    use(patch);
  }
}

// In a heap that trembles under the iterative solver some contact always slides; a prediction pays only when a
// considerable share of the load does.
bool StepSolver::findSliding(Islands& islands) {
  sliding_.assign(bodies_.size(), 0);
  load_.assign(bodies_.size(), {});
  forEachPatch([&](const Patch& patch) {
    const std::size_t island = islands.of(patch.body);
    load_[island].all += patch.cone;
    if (patch.friction <= kAtLimit * patch.cone || slipOf(patch) < (solver_.isDirect() ? kSlides : kRestSpeed)) return;
    load_[island].sliding += patch.cone;
  });
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    sliding_[i] = load_[i].sliding > (solver_.isDirect() ? 0 : kSlidingShare) * load_[i].all ? 1 : 0;
  }
  return any(sliding_);
}

double StepSolver::slipOf(const Patch& patch) const {
  double slip = 0;
  for (std::size_t i = patch.first; i < patch.end; ++i) slip = std::max(slip, joints_.slip(i, bodies_).norm());
  return slip;
}

void StepSolver::putBack(Islands& islands, const std::vector<char>& wanted) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (bodies_.awake(i) && wanted[islands.of(i)] != 0) bodies_.restore(i);
  }
}

void StepSolver::predict(FingerJoints& fingers, Islands& islands, const std::vector<char>& wanted, double h) {
  counts.predictions += static_cast<std::uint64_t>(std::count(wanted.begin(), wanted.end(), 1));
  pass(fingers, islands, wanted, h, false);
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const BodyContact& c = joints_.contact(i);
    if (wanted[islandOf(i, islands)] == 0) continue;
    const Vec3 slip = joints_.slip(i, bodies_);
    joints_[i].direction = frictionDirection(c.nhat_AB_W, slip);
    joints_[i].slides = slip.norm() > kSlidesFast && solver_.isDirect();
  }
  putBack(islands, wanted);
  // friction in a second direction would hold a contact on the predicted line although other contacts may deflect it,
  // so a contact that slides fast, now and in the prediction, gets none
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    joints_[i].slides = joints_[i].slides && joints_.slip(i, bodies_).norm() > kSlidesFast;
  }
}

// Friction above its cone: the normal force has fallen since the last step (after an impact), or friction was not
// aligned with the slip. Friction at its bound but well inside its cone: the normal force has risen.
bool StepSolver::judge(Islands& islands) {
  wrong_.assign(bodies_.size(), 0);
  forEachPatch([&](const Patch& patch) {
    const std::size_t island = islands.of(patch.body);
    const bool exceeds = patch.friction > (1 + kTolerance) * patch.cone;
    const bool lags = patch.friction > kAtLimit * patch.limit && patch.friction < (1 - kLag) * patch.cone;
    if (solver_.isDirect() && (exceeds || lags)) wrong_[island] = 1;
  });
  // also repeat islands on which the direct solver failed: its own friction bound at an unloaded contact may be the
  // cause
  for (std::size_t i = 0; i < bodies_.size(); ++i) wrong_[i] = wrong_[i] != 0 || fell_back_[i] != 0 ? 1 : 0;
  counts.repeats += static_cast<std::uint64_t>(std::count(wrong_.begin(), wrong_.end(), 1));
  return any(wrong_);
}

}  // namespace presa::ode
