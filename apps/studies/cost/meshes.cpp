#include "apps/studies/cost/meshes.h"

#include <filesystem>
#include <map>

#include "apps/common/atomic_file.h"
#include "apps/common/terminal/text.h"
#include "framework/geometry/decimate.h"

namespace presa::cost {
namespace {

namespace fs = std::filesystem;

std::string objText(const TriMesh& mesh) {
  std::string text;
  for (const Vec3& v : mesh.vertices) text += terminal::format("v %.9g %.9g %.9g\n", v.x(), v.y(), v.z());
  for (const TriMesh::Triangle& t : mesh.triangles)
    text += terminal::format("f %d %d %d\n", t[0] + 1, t[1] + 1, t[2] + 1);
  return text;
}

/// Writes the decimated mesh. Edge collapses may leave an edge with three triangles, which the importer rejects; retry
/// then with slightly fewer triangles.
TriMesh decimated(const TriMesh& source, const Decimation& wanted) {
  constexpr int kTries = 20;
  const double count = wanted.part * static_cast<double>(source.triangles.size());
  for (int attempt = 0;; ++attempt) {
    TriMesh coarse = decimateMesh(source, static_cast<std::size_t>(count * (1 - 0.005 * attempt)));
    writeFileAtomically(wanted.file, objText(coarse));
    Diagnostics findings;
    importMesh(wanted.file, {.must_be_closed = false}, {wanted.file, 0, 0}, findings);
    if (!findings.hasErrors() || attempt == kTries) return coarse;
  }
}

}  // namespace

std::vector<Result::Mesh> makeMeshes(const Study& study) {
  std::vector<Result::Mesh> made;
  std::map<std::string, TriMesh> sources;
  for (const Factor& factor : study.factors) {
    for (const FactorValue& value : factor.values) {
      for (const Decimation& wanted : value.meshes) {
        Diagnostics diagnostics;
        if (!sources.contains(wanted.source))
          sources[wanted.source] =
              importMesh(wanted.source, {.must_be_closed = false}, {wanted.source, 0, 0}, diagnostics);
        if (diagnostics.hasErrors()) throw InputError(diagnostics);
        const TriMesh& source = sources[wanted.source];
        fs::create_directories(fs::path(wanted.file).parent_path());
        const TriMesh coarse = decimated(source, wanted);
        made.push_back({wanted.body, value.name, source.triangles.size(), coarse.triangles.size(),
                        hausdorffDistance(source, coarse)});
      }
    }
  }
  return made;
}

}  // namespace presa::cost
