// qhull_ra.h declares what FORALLfacets needs
extern "C" {
#include <libqhull_r/qhull_ra.h>
}

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "framework/grasp/hull_abi.h"

namespace presa {
namespace {

/// The library writes to files only; what it says about flat points is in its return value.
struct Silence {
  std::FILE* file = ::fmemopen(nullptr, 4096, "w");
  Silence() = default;
  ~Silence() {
    if (file != nullptr) std::fclose(file);
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;
};

int hullWith(const char* options, std::vector<double> points, std::int32_t dimension, HullFacetFunction facet,
             void* user) {
  const Silence silence;
  const auto hull = std::make_unique<qhT>();
  qh_zero(hull.get(), silence.file);
  std::string command = options;  // Qhull may write to it, as to the points
  const auto count = static_cast<int>(points.size()) / dimension;
  const int status =
      qh_new_qhull(hull.get(), dimension, count, points.data(), False, command.data(), silence.file, silence.file);
  if (status == 0) {
    for (const facetT* f = hull->facet_list; f != nullptr && f->next != nullptr; f = f->next)
      facet(user, f->normal, -f->offset);
  }
  qh_freeqhull(hull.get(), qh_ALL);
  int blocks = 0, bytes = 0;
  qh_memfreeshort(hull.get(), &blocks, &bytes);
  return status;
}

}  // namespace
}  // namespace presa

extern "C" __attribute__((visibility("default"))) std::int32_t presaConvexHull(const double* points, std::int32_t count,
                                                                               std::int32_t dimension,
                                                                               presa::HullFacetFunction facet,
                                                                               void* user) {
  const std::vector<double> all(points, points + static_cast<std::ptrdiff_t>(count) * dimension);
  // Many points lie in one plane. C-0 merges facets that rounding makes concave; where that fails, QJ moves the points
  // by about 1e-11 of their size. Pp: no warnings.
  const int status = presa::hullWith("qhull C-0 Pp", all, dimension, facet, user);
  return status == 0 ? 0 : presa::hullWith("qhull QJ Pp", all, dimension, facet, user);
}
