#pragma once
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "framework/geometry/tri_mesh.h"
#include "framework/input/folders.h"

namespace presa::test {

/// A mesh in a file that goes with it.
class MeshFile {
 public:
  MeshFile(const TriMesh& mesh, const std::string& name)
      : file_(std::filesystem::temp_directory_path() / ("presa_" + std::to_string(getpid()) + "_" + name + ".obj")) {
    input::allowFolder(file_.parent_path().string());
    std::ofstream out(file_);
    out.precision(9);
    for (const Vec3& v : mesh.vertices) out << "v " << v.x() << ' ' << v.y() << ' ' << v.z() << '\n';
    for (const TriMesh::Triangle& t : mesh.triangles)
      out << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
  }
  ~MeshFile() { std::filesystem::remove(file_); }
  MeshFile(const MeshFile&) = delete;
  MeshFile& operator=(const MeshFile&) = delete;

  std::string path() const { return file_.string(); }
  /// A fixed body of it; `pose`: attributes.
  std::string body(const std::string& name, const std::string& material, const std::string& pose = "") const {
    return "<body name=\"" + name + "\" fixed=\"true\" material=\"" + material + "\" " + pose +
           "><haptic><mesh file=\"" + file_.string() + "\"/></haptic></body>";
  }

 private:
  std::filesystem::path file_;
};

}  // namespace presa::test
