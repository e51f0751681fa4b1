#include "apps/common/grasp_strength.h"

#include "framework/grasp/words.h"

namespace presa {
namespace {

bool presses(const FingerContact& finger, std::int32_t body) {
  return finger.mode != ContactMode::kNone && finger.body == body && finger.normal_force > 0;
}

/// The last sample of the hold in which two fingers or more press on the object; null: none.
const TraceSample* lastHeld(const RunResult& result, const GraspFigures& figures) {
  const std::int32_t body = result.objects[figures.object].body;
  const TraceSample* last = nullptr;
  for (const TraceSample& sample : *result.trace) {
    if (sample.time < figures.hold_begin || sample.time >= figures.hold_end) continue;
    std::size_t pressing = 0;
    for (const FingerGrasp& finger : figures.fingers)
      pressing += presses(sample.fingers[finger.contact_point], body) ? 1 : 0;
    if (pressing >= 2) last = &sample;
  }
  return last;
}

void addFinger(const FingerContact& finger, std::size_t contact_point, double torsion, GraspStrength& strength) {
  strength.grasp.contacts.push_back(
      {finger.p_WP, -finger.nhat_W, finger.friction_static, torsion, finger.normal_force});
  strength.contact_points.push_back(contact_point);
  const double bound = finger.friction_static * finger.normal_force;
  strength.friction_used.push_back(bound > 0 ? finger.tangential_force_W.norm() / bound : 0);
}

}  // namespace

std::optional<GraspStrength> graspStrength(const RunResult& result, const GraspFigures& figures) {
  const RunResult::Object& object = result.objects[figures.object];
  const TraceSample* sample = object.friction_static > 0 ? lastHeld(result, figures) : nullptr;
  if (sample == nullptr) return std::nullopt;
  const auto body = static_cast<std::size_t>(object.body);
  const Scene& scene = result.world->scene;
  const BodyInertia& inertia = result.world->inertias[body];
  GraspStrength strength;
  strength.time = sample->time;
  strength.grasp.centre = sample->bodies[static_cast<std::size_t>(object.trace_slot)] * inertia.p_BCm;
  strength.grasp.length = gyrationLength(inertia.mass, inertia.inertia);
  if (!(strength.grasp.length > 0)) return std::nullopt;
  std::vector<std::string> names;
  for (const FingerGrasp& held : figures.fingers) {
    const FingerContact& finger = sample->fingers[held.contact_point];
    if (!presses(finger, object.body)) continue;
    addFinger(finger, held.contact_point, scene.materialOf(scene.bodies[body]).torsional_radius, strength);
    names.push_back(result.contact_points[held.contact_point].name);
  }
  strength.quality = graspQuality(strength.grasp, GripBound::kSum);
  strength.weakest = motionWords(strength.grasp, strength.quality.weakest, names, -scene.gravity);
  strength.weight = inertia.mass * scene.gravity.norm();
  const Wrench weight(inertia.mass * scene.gravity);
  strength.slip_margin = loadFactor(strength.grasp, weight);
  strength.min_grip = minGrip(strength.grasp, weight);
  return strength;
}

const char* toString(GraspClosure closure) {
  switch (closure) {
    case GraspClosure::kFull:
      return "full";
    case GraspClosure::kPartial:
      return "partial";
    case GraspClosure::kNone:
      break;
  }
  return "none";
}

}  // namespace presa
