#include "framework/geometry/obj_text.h"

#include <array>
#include <cstdio>

namespace presa {

std::string objText(const TriMesh& mesh, int digits) {
  std::string text;
  std::array<char, 128> line{};
  const auto add = [&](int size) { text.append(line.data(), static_cast<std::size_t>(size)); };
  for (const Vec3& v : mesh.vertices)
    add(std::snprintf(line.data(), line.size(), "v %.*g %.*g %.*g\n", digits, v.x(), digits, v.y(), digits, v.z()));
  for (const TriMesh::Triangle& t : mesh.triangles)
    add(std::snprintf(line.data(), line.size(), "f %d %d %d\n", t[0] + 1, t[1] + 1, t[2] + 1));
  return text;
}

}  // namespace presa
