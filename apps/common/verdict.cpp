#include "apps/common/verdict.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "apps/common/grasp_figures.h"
#include "apps/common/losses.h"
#include "apps/common/number_text.h"

namespace presa {
namespace {

std::string offsetSentence(const GraspFigures& figures) {
  double widest = 0;
  for (const FingerGrasp& finger : figures.fingers) widest = std::max(widest, finger.offset_range);
  return "Finger and object kept their offset to " + fixed(widest * 1000, 3) + " mm during the hold.";
}

std::string degrees(double angle) { return fixed(angle * 180 / std::numbers::pi, 0) + "°"; }

bool turned(const GraspFigures& figures) { return figures.turn && figures.turn->objectTurned(); }
bool buckled(const GraspFigures& figures) { return figures.turn && figures.turn->handBuckled(); }

/// How the grasp came away from how it began, for the headline; empty: it did not.
std::string turnWords(const GraspFigures& figures) {
  if (turned(figures) && buckled(figures)) return ", but turned in the grip of a hand that buckled";
  if (turned(figures)) return ", but turned by " + degrees(figures.turn->object) + " in the grip";
  return buckled(figures) ? ", but the hand buckled" : "";
}

std::string buckleSentence(const GraspTurn& turn) {
  return "The hand buckled: the line between the fingers turned by up to " + degrees(turn.hand) +
         " after they grasped, and they went " + fixed(turn.sideways * 1000, 1) +
         " mm sideways. A lighter grip, or fingers that are stiffer sideways, hold straight.";
}

std::string turnSentence(const GraspTurn& turn) {
  return "The object turned by up to " + degrees(turn.object) +
         " about the line between the fingers, which touch it in points. A grasp above its centre of mass keeps it " +
         "upright.";
}

/// How the fingers slipped when the motion let go; none if it never came to that.
std::optional<std::string> slipSentence(const RunResult& result, const GraspFigures& figures) {
  const double end = result.stopped_at < 0 ? result.simulated_seconds : result.stopped_at;
  if (!(figures.release_begin < end)) return std::nullopt;
  std::string slips;
  for (const FingerGrasp& finger : figures.fingers) {
    if (!finger.slip) continue;
    if (!slips.empty()) slips += ", ";
    slips += result.contact_points[finger.contact_point].name + " at " + fixed(finger.slip->normal_force, 3) + " N";
  }
  if (slips.empty()) return "No slip after the release began.";
  if (!(figures.slip_limit > 0)) return "Slipped: " + slips + ".";
  return "Slipped: " + slips + "; friction stops carrying the weight at m g / (" +
         std::to_string(figures.fingers.size()) + " μₛ) = " + fixed(figures.slip_limit, 3) + " N.";
}

constexpr double kSlipTold = 0.01;  // of the limit

/// Names the step of the dynamics where it explains a slip that is not at the limit: the object loads the finger once in
/// a step, and a slip is seen up to one step early or late.
std::optional<std::string> slipStepSentence(const RunResult& result, const GraspFigures& figures) {
  for (const FingerGrasp& finger : figures.fingers) {
    if (!finger.slip || !(figures.slip_limit > 0)) continue;
    const double off = std::abs(finger.slip->normal_force - figures.slip_limit);
    if (off < kSlipTold * figures.slip_limit || off > finger.slip_step) continue;
    return result.contact_points[finger.contact_point].name + " slipped " + fixed(100 * off / figures.slip_limit, 1) +
           " % off that: its grip fell by " + fixed(finger.slip_step, 3) +
           " N in the step of the dynamics before. A higher rate of the dynamics resolves it better.";
  }
  return std::nullopt;
}

/// The motion says what its phases are for.
bool intended(const RunResult& result) {
  return std::any_of(result.phases.begin(), result.phases.end(),
                     [](const RunResult::Phase& phase) { return phase.intent != PhaseIntent::kNone; });
}

/// Only a motion with intents knows whether a loss was wanted.
std::string lossSentence(const RunResult& result, const RunResult::Object& object) {
  const std::string at = fixed(object.summary.lost_at, 3) + " s";
  if (object.summary.dropped) return "Dropped at " + at + ", before it was to be released.";
  return (intended(result) ? "Released at " : "Out of the fingers from ") + at + (intended(result) ? "." : " on.");
}

// The bound that action and reaction are held to. A force that changes within a dynamics step, as with the steps of an
// encoder under a light grip, exceeds it: the dynamics learn of it one step later.
constexpr double kImpulseBound = 0.01;

std::optional<std::string> impulseSentence(const RunResult& result) {
  const RunResult::ContactPoint* worst = nullptr;
  for (const RunResult::ContactPoint& point : result.contact_points) {
    const double error = point.summary.reaction.worst;
    if (error > kImpulseBound && (worst == nullptr || error > worst->summary.reaction.worst)) worst = &point;
  }
  if (worst == nullptr) return std::nullopt;
  const ActionReaction::Result& reaction = worst->summary.reaction;
  const Scene& scene = result.world->scene;
  const bool may_be_held = scene.dynamics.coupling == DynamicsSettings::Coupling::kSoft &&
                           scene.dynamics.engine == kDefaultEngine && !scene.assembly;
  return "The impulse on the object and the one that " + worst->name + " felt differed by up to " +
         fixed(100 * reaction.worst, 1) + " % over 0.1 s (until " + fixed(reaction.time, 3) + " s)." +
         (may_be_held ? " <dynamics coupling=\"haptic_rate\"> gives bodies exactly what fingers feel." : "");
}

constexpr double kEnergyTold = 1e-3;  // [J], a grain of rice that falls 5 m
constexpr double kLagTold = 0.02;     // [s], below it nobody sees

/// What the dynamics did that nature does not.
std::vector<std::string> dynamicsSentences(const RunResult& result) {
  std::vector<std::string> all;
  if (result.stopped_short > 0) {
    all.push_back(std::to_string(result.stopped_short) + (result.stopped_short == 1 ? " time" : " times") +
                  " a body was stopped short of passing through another within a step.");
  }
  if (result.too_many_held > 0) {
    all.push_back(std::to_string(result.too_many_held) + (result.too_many_held == 1 ? " time" : " times") +
                  " a group of bodies in contact was too large for the haptic thread (max_held " +
                  std::to_string(result.world->scene.dynamics.max_held) + "): it moved at the rate of the dynamics.");
  }
  if (result.energy_created.sum > kEnergyTold) {
    all.push_back("The dynamics created " + fixed(1e3 * result.energy_created.sum, 1) + " mJ from nothing, " +
                  fixed(1e3 * result.energy_created.worst_step, 1) + " mJ in the worst step.");
  }
  if (result.far_lag > kLagTold) {
    all.push_back("Objects that no finger reached stood still for " + fixed(result.far_lag, 2) + " of " +
                  fixed(result.simulated_seconds, 2) + " s, as the dynamics were late: what was touched came first.");
  }
  return all;
}

Verdict graspVerdict(const RunResult& result, const GraspFigures& figures) {
  const RunResult::Object& object = result.objects[figures.object];
  Verdict verdict;
  verdict.outcome = object.summary.dropped ? Verdict::Outcome::kBad : Verdict::Outcome::kGood;
  // the mean height of a hold means nothing for what flew away in it
  const bool tell_height = figures.lifted && !object.summary.dropped;
  verdict.headline = object.name + (object.summary.dropped ? " dropped," : "") +
                     (tell_height ? " lifted by " + fixed(figures.lift_height * 1000, 1) + " mm," : "") +
                     " held in stick for " + fixed(figures.held_in_stick, 2) + " of " +
                     fixed(figures.hold_end - figures.hold_begin, 2) + " s" + turnWords(figures);
  if (verdict.outcome == Verdict::Outcome::kGood && (turned(figures) || buckled(figures)))
    verdict.outcome = Verdict::Outcome::kNeutral;
  if (!object.summary.dropped) verdict.details.push_back(offsetSentence(figures));
  if (const auto sentence = slipSentence(result, figures)) verdict.details.push_back(*sentence);
  if (const auto sentence = slipStepSentence(result, figures)) verdict.details.push_back(*sentence);
  if (turned(figures)) verdict.details.push_back(turnSentence(*figures.turn));
  if (buckled(figures)) verdict.details.push_back(buckleSentence(*figures.turn));
  if (object.summary.lost_at >= 0) verdict.details.push_back(lossSentence(result, object));
  return verdict;
}

Verdict plainVerdict(const RunResult& result) {
  Verdict verdict;
  std::string grasped;
  for (const RunResult::Object& object : result.objects) {
    if (!object.summary.grasped) continue;
    grasped += (grasped.empty() ? "" : ", ") + object.name;
    if (object.summary.lost_at >= 0) verdict.details.push_back(object.name + ": " + lossSentence(result, object));
    if (object.summary.dropped) verdict.outcome = Verdict::Outcome::kBad;
  }
  if (grasped.empty()) {
    verdict.headline = result.objects.empty() ? "nothing to grasp in this scene" : "no object was grasped";
  } else {
    verdict.headline = grasped + (verdict.outcome == Verdict::Outcome::kBad ? " grasped and dropped" : " grasped");
    if (!result.phases.empty() && !intended(result))
      verdict.details.emplace_back(
          "The motion does not say what its phases are for: intent=\"hold\" and intent=\"release\" on them give the "
          "figures of the grasp.");
  }
  return verdict;
}

/// Rendered forces end with the stop (FingerSummary), those of the device with its fade.
std::string stopSentence(const RunResult& result) {
  const double at = result.stopped_at < 0 ? result.simulated_seconds : result.stopped_at;
  return "Stopped by you at " + fixed(at, 3) + " s" +
         (result.stopped_at < 0 ? "." : "; forces faded until " + fixed(result.simulated_seconds, 3) + " s.");
}

}  // namespace

Verdict verdictOf(const RunResult& result) {
  const std::optional<GraspFigures> figures = graspFigures(result);
  Verdict verdict = figures ? graspVerdict(result, *figures) : plainVerdict(result);
  if (result.interrupted || result.stopped_at >= 0) verdict.details.push_back(stopSentence(result));
  if (const auto sentence = impulseSentence(result)) verdict.details.push_back(*sentence);
  for (std::string& sentence : dynamicsSentences(result)) verdict.details.push_back(std::move(sentence));
  verdict.warnings = lossesOf(result);
  if (!verdict.warnings.empty() && verdict.outcome == Verdict::Outcome::kGood)
    verdict.outcome = Verdict::Outcome::kNeutral;
  if (!result.faults.empty()) {
    verdict.outcome = Verdict::Outcome::kBad;
    verdict.details.push_back(std::to_string(result.faults.size()) +
                              (result.faults.size() == 1 ? " fault, listed below." : " faults, listed below."));
  }
  return verdict;
}

}  // namespace presa
