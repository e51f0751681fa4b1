#include <algorithm>
#include <cmath>

#include "experiments/stability/bodies.h"
#include "experiments/stability/cases.h"
#include "experiments/stability/folder.h"
#include "experiments/stability/masonry_arch.h"
#include "experiments/stability/methods.h"

namespace presa::stability::mesh_arch {
namespace {

constexpr int kStones = 15;                               // as in the scene, as are the radius and the width
constexpr double kRadius = 0.2, kWidth = 0.06;            // [m]
constexpr double kStands = 30, kFalls = 4, kSettled = 1;  // [s]

std::string stone(int i) { return "v" + std::to_string(i); }

/// An arch of a thickness over its radius, watched in every step.
class Watched {
 public:
  Watched(double thickness, double duration, const Method& method)
      : folder_("mesh_arch"), run_(specOf("mesh_arch.xml", setsOf(thickness) + method, duration)) {
    for (int i = 0; i < kStones; ++i) stones_.push_back(bodyNamed(run_.world(), stone(i)));
    run_.observe(atEachStep([this](const ObjectState& state) { see(state); }));
    run_.run();
  }
  double height() const { return crown_.y.back() / 1000; }  ///< of the crown [m]
  double farthest() const { return farthest_; }             ///< of the crown [m]
  double fastest() const { return fastest_; }               ///< stone, once settled [m/s]
  Finding withCurve(Finding finding) const {
    finding.plot_x = "time [s]";
    finding.plot_y = "height of the keystone [mm]";
    finding.curves = {decimated(crown_)};
    return finding;
  }

 private:
  // awake: a sleeping arch stands whatever its thrust
  std::vector<std::string> setsOf(double thickness) const {
    const std::string mesh = folder_.file("voussoir.obj");
    writeObj(archStone({kStones, kRadius, thickness * kRadius}, kWidth), mesh);
    std::vector<std::string> sets{"dynamics/sleeping=false"};
    for (int i = 0; i < kStones; ++i) sets.push_back("body/" + stone(i) + "/physics/mesh/file=" + mesh);
    return sets;
  }
  void see(const ObjectState& state) {
    const std::size_t keystone = stones_[kStones / 2];
    const Vec3& crown = state.bodies[keystone].X_WB_end.p;
    farthest_ = std::max(farthest_, (crown - run_.world().scene.bodies[keystone].X_WB.p).norm());
    crown_.x.push_back(state.time_end);
    crown_.y.push_back(1000 * crown.z());
    if (state.time_end < kSettled) return;
    for (const std::size_t i : stones_) fastest_ = std::max(fastest_, state.bodies[i].v_WB.norm());
  }

  Folder folder_;
  StudyRun run_;
  std::vector<std::size_t> stones_;
  double farthest_ = 0, fastest_ = 0;
  Curve crown_{"keystone", {}, {}};
};

std::string limit() { return "thickness / radius from " + number(minThickness(kStones)) + " on, by limit analysis"; }

std::vector<Finding> stand(double thickness, const Method& method) {
  const Watched arch(thickness, kStands, method);
  return {arch.withCurve(finding("displacement of the keystone", 1000 * arch.farthest(), "mm", 0.1,
                                 "a line of thrust fits: " + limit())),
          finding("fastest stone after 1 s", 1000 * arch.fastest(), "mm/s", 1, "an arch that stands is at rest")};
}

std::vector<Finding> fall(double thickness, const Method& method) {
  const Watched arch(thickness, kFalls, method);
  return {arch.withCurve(finding("height of the keystone left", 100 * arch.height() / kRadius, "%", 50,
                                 "no line of thrust fits: an arch stands with " + limit()))};
}

}  // namespace

Case make() {
  Case result;
  result.name = "mesh_arch";
  result.title = "A semicircular arch of fifteen stones, each a mesh, stands or falls by its thickness";
  result.source =
      "Min thickness of a semicircular arch, 0.1075 of its radius: M. Milankovitch, Z. Math. Phys. 55 (1907), 1; "
      "G. Cocchetti, G. Colasante, E. Rizzi, Appl. Mech. Rev. 64 (2011), 050802.";
  result.oracle = "The arch stands when a line of thrust fits in it; for fifteen straight stones from 0.1061 on.";
  result.scene = "mesh_arch.xml";
  const double limit = minThickness(kStones);
  for (const double thickness : {0.3, 0.2, 0.12, 1.02 * limit, 0.98 * limit, 0.1, 0.08}) {
    const bool stands = thrustLineFits({kStones, 1, thickness});
    for (const Method& method : {ours(), twentyIterations()}) {
      if (!stands && !method.own()) continue;  // a method that lets every arch fall proves nothing by it
      Trial trial;
      trial.parameters = {{"thickness / radius", number(thickness)}, {"arch", stands ? "stands" : "falls"}};
      trial.method = method.name;
      if (!method.own()) trial.expected = Verdict::kUnstable;
      trial.run = [=] { return stands ? stand(thickness, method) : fall(thickness, method); };
      trial.quick = thickness < 0.15;
      result.trials.push_back(std::move(trial));
    }
  }
  return result;
}

}  // namespace presa::stability::mesh_arch
