#include <cmath>

#include "experiments/stability/cases.h"
#include "experiments/stability/folder.h"
#include "experiments/stability/masonry_arch.h"
#include "experiments/stability/methods.h"
#include "experiments/stability/pile.h"

namespace presa::stability::mesh_arch {
namespace {

constexpr int kStones = 15;                     // as in the scene, as are the radius and the width
constexpr double kRadius = 0.2, kWidth = 0.06;  // [m]
constexpr double kStands = 30, kFalls = 4;      // [s]

/// `thickness` over the radius.
std::vector<Finding> build(double thickness, bool stands, const Method& method) {
  const Folder folder("mesh_arch");
  const std::string mesh = folder.file("voussoir.obj");
  writeObj(archStone({kStones, kRadius, thickness * kRadius}, kWidth), mesh);
  std::vector<std::string> sets{"dynamics/sleeping=false"};  // a sleeping arch stands whatever its thrust
  for (int i = 0; i < kStones; ++i) sets.push_back("body/v" + std::to_string(i) + "/physics/mesh/file=" + mesh);
  Pile arch(specOf("mesh_arch.xml", sets + method, stands ? kStands : kFalls), "v" + std::to_string(kStones / 2));
  arch.run();
  if (stands) return {arch.displacement(0.1), arch.restSpeed()};
  return {arch.heightLeft("no line of thrust fits below " + number(minThickness(kStones)))};
}

}  // namespace

Case make() {
  Case result;
  result.name = "mesh_arch";
  result.title = "A semicircular arch of fifteen stones, each a mesh, stands or falls by its thickness";
  result.source =
      "Min thickness of a semicircular arch, 0.1075 of its radius: M. Milankovitch, Z. Math. Phys. 55 (1907), 1; G. "
      "Cocchetti, G. Colasante, E. Rizzi, Appl. Mech. Rev. 64 (2011), 050802.";
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
      trial.run = [=] { return build(thickness, stands, method); };
      trial.quick = method.own() && std::abs(thickness / limit - 1) < 0.03;
      result.trials.push_back(std::move(trial));
    }
  }
  return result;
}

}  // namespace presa::stability::mesh_arch
