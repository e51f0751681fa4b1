#include <algorithm>
#include <cmath>
#include <cstdio>

#include "experiments/stability/bodies.h"
#include "experiments/stability/cases.h"

namespace presa::stability::far_from_origin {
namespace {

constexpr double kLength = 0.01;  // makes an angle of a distance [m]

struct Place {
  std::string name;
  Vec3 p = Vec3::Zero();
};
struct Played {
  std::string scene, name;
  double duration = 0;  ///< [s]
  /// How far a body may be from the run at the origin [m]. 1 nm: ten thousand times the rounding of a coordinate of 1
  /// km.
  double bound = 1e-9;
};

/// Poses of all bodies after each step, in relation to `place`.
using Poses = std::vector<std::vector<Pose>>;

// awake: sleeping bodies would keep the first difference
std::vector<std::string> awake() { return {"dynamics/sleeping=false"}; }

/// Settings that move every body of a scene by `place`.
std::vector<std::string> movedBy(const World& world, const Vec3& place) {
  std::vector<std::string> sets = awake();
  for (const Body& body : world.scene.bodies) {
    const Vec3 p = body.X_WB.p + place;
    char text[160];
    std::snprintf(text, sizeof text, "body/%s/pos=%.17g %.17g %.17g", body.name.c_str(), p.x(), p.y(), p.z());
    sets.emplace_back(text);
  }
  return sets;
}

Poses play(StudyRun& run, const Vec3& place) {
  Poses all;
  run.observe(atEachStep([&](const ObjectState& state) {
    std::vector<Pose> now;
    for (const BodyMotion& body : state.bodies) now.push_back({body.X_WB_end.p - place, body.X_WB_end.q});
    all.push_back(std::move(now));
  }));
  run.run();
  return all;
}

std::vector<Finding> compare(const Played& played, const Vec3& place) {
  Poses here, there;
  std::vector<std::string> moved;
  {
    StudyRun run(specOf(played.scene, awake(), played.duration));
    moved = movedBy(run.world(), place);
    here = play(run, Vec3::Zero());
  }
  StudyRun run(specOf(played.scene, moved, played.duration));
  there = play(run, place);
  if (here.size() != there.size()) throw std::logic_error("two runs of one length differ in their steps");

  double shift = 0, turn = 0;
  Curve shown{"difference", {}, {}};
  for (std::size_t k = 0; k < here.size(); ++k) {
    double now = 0;
    for (std::size_t i = 0; i < here[k].size(); ++i) {
      now = std::max(now, (there[k][i].p - here[k][i].p).norm());
      turn = std::max(turn, there[k][i].q.angularDistance(here[k][i].q));
    }
    shift = std::max(shift, now);
    shown.x.push_back(static_cast<double>(k));
    shown.y.push_back(std::log10(std::max(1e-16, now)));
  }
  Finding apart = finding("bodies apart from the run at the origin", 1e9 * shift, "nm", 1e9 * played.bound,
                          "a place is no part of mechanics; rounding is 1e-13 m at 1 km, 1e-12 m at 10 km");
  apart.plot_x = "step";
  apart.plot_y = "largest difference, log10 [m]";
  apart.curves = {decimated(std::move(shown))};
  return {apart, finding("angle to the run at the origin", 1e9 * turn, "nrad", 1e9 * played.bound / kLength,
                         "likewise, over 10 mm")};
}

}  // namespace

Case make() {
  Case result;
  result.name = "far_from_origin";
  result.title = "Towers, cards, an arch and dominoes stand and fall alike a kilometre away";
  result.source =
      "Mechanics has no preferred place; single precision, or a difference of large coordinates in a contact, shows "
      "here.";
  result.oracle = "Every body keeps its place beside the run at the origin, to what rounding grows to.";
  result.scene = "falling_tower.xml";
  // an arch whose stones touch by rounding settles by up to its yield, 7 um; dominoes until the last one falls: where
  // all slide on each other, the least difference grows without bound
  for (const Played& played :
       {Played{"falling_tower.xml", "tower of 20 cubes", 10}, Played{"card_house.xml", "cards", 5},
        Played{"mesh_arch.xml", "arch of meshes", 5, 7e-6}, Played{"overhang.xml", "overhang", 5},
        Played{"domino_row.xml", "dominoes", 0.6}, Played{"mesh_stack.xml", "meshes", 5}}) {
    for (const Place& place : {Place{"1 km", Vec3(600, -800, 0)}, Place{"10 km", Vec3(6000, 8000, 0)}}) {
      Trial trial;
      trial.parameters = {{"scene", played.name}, {"distance", place.name}};
      trial.method = kPresa;
      trial.run = [=] { return compare(played, place.p); };
      trial.quick = place.p.x() > 1000;
      result.trials.push_back(std::move(trial));
    }
  }
  return result;
}

}  // namespace presa::stability::far_from_origin
