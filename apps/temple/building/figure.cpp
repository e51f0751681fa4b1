#include "apps/temple/building/figure.h"

#include <array>
#include <cmath>
#include <numbers>

#include "apps/temple/building/ring_stack.h"

namespace presa::temple {
namespace {

constexpr std::size_t kAround = 24;

/// A cross-section in parts of the person's height: half width (x), half depth (y), and the depth of the gown's folds.
struct Section {
  double z, width, depth, folds, y;
};
// breadth of shoulders a quarter of the height, head an eighth: the canon of a standing figure
constexpr std::array kBody{Section{0.000, 0.085, 0.070, 0.10, 0},      Section{0.030, 0.098, 0.078, 0.12, 0},
                           Section{0.250, 0.086, 0.066, 0.12, 0},      Section{0.420, 0.094, 0.068, 0.08, 0},
                           Section{0.520, 0.100, 0.070, 0.04, 0},      Section{0.545, 0.090, 0.066, 0.02, 0},
                           Section{0.600, 0.076, 0.056, 0.00, 0},      Section{0.620, 0.088, 0.066, 0.03, 0},
                           Section{0.700, 0.104, 0.072, 0.02, -0.004}, Section{0.770, 0.114, 0.064, 0.00, 0},
                           Section{0.810, 0.106, 0.052, 0.00, 0.002},  Section{0.832, 0.060, 0.040, 0.00, 0.004},
                           Section{0.845, 0.030, 0.030, 0.00, 0.004},  Section{0.868, 0.028, 0.030, 0.00, 0.000},
                           Section{0.882, 0.036, 0.044, 0.00, -0.004}, Section{0.915, 0.046, 0.056, 0.00, -0.002},
                           Section{0.950, 0.048, 0.058, 0.00, 0.004},  Section{0.980, 0.036, 0.044, 0.00, 0.006},
                           Section{0.995, 0.016, 0.020, 0.00, 0.006}};
constexpr std::array kArm{Section{0.425, 0.010, 0.013, 0, -0.024}, Section{0.440, 0.017, 0.020, 0, -0.022},
                          Section{0.490, 0.015, 0.019, 0, -0.018}, Section{0.600, 0.021, 0.024, 0, 0.000},
                          Section{0.700, 0.025, 0.028, 0, 0.004},  Section{0.770, 0.026, 0.030, 0, 0.002},
                          Section{0.800, 0.014, 0.018, 0, 0.002}};

Ring ringOf(const Section& section, double height, double aside) {
  Ring ring;
  for (std::size_t i = 0; i < kAround; ++i) {
    const double turn = 2 * std::numbers::pi * static_cast<double>(i) / kAround;
    const double fold = 1 + section.folds * (i % 2 == 0 ? 1 : -1);
    ring.push_back(height * Vec3(aside + fold * section.width * std::cos(turn),
                                 section.y + fold * section.depth * std::sin(turn), section.z));
  }
  return ring;
}

template <class Sections>
void append(TriMesh& mesh, const Sections& sections, double height, double aside) {
  std::vector<Ring> rings;
  for (const Section& section : sections) rings.push_back(ringOf(section, height, aside));
  const auto centerOf = [&](const Section& section) { return Vec3(height * Vec3(aside, section.y, section.z)); };
  const TriMesh part = stackRings(rings, centerOf(sections.front()), centerOf(sections.back()));
  const auto first = static_cast<std::int32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), part.vertices.begin(), part.vertices.end());
  for (const TriMesh::Triangle& t : part.triangles)
    mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
}

}  // namespace

TriMesh makeFigure(double height) {
  TriMesh mesh;
  // the crown of the head is the highest point
  const double full = height / kBody.back().z;
  append(mesh, kBody, full, 0);
  for (const double side : {-1.0, 1.0}) append(mesh, kArm, full, side * 0.113);
  buildAdjacency(mesh);
  return mesh;
}

}  // namespace presa::temple
