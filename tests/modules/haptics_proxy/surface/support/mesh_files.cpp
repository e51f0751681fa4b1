#include "tests/modules/haptics_proxy/surface/support/mesh_files.h"

#include <cstdio>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace presa::test {
namespace {

/// The file's words without comments.
std::istringstream wordsOf(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error("cannot read " + file.string());
  std::string text, line;
  while (std::getline(in, line)) text += line.substr(0, line.find('#')) + "\n";
  return std::istringstream(text);
}

std::vector<double> numbersOf(const std::string& line) {
  std::istringstream words(line);
  std::vector<double> numbers;
  for (double number = 0; words >> number;) numbers.push_back(number);
  return numbers;
}

/// The numbers of the next line that is not empty.
std::vector<double> nextNumbers(std::istringstream& text, const std::filesystem::path& file) {
  for (std::string line; std::getline(text, line);) {
    if (line.find_first_not_of(" \t\r\n") != std::string::npos) return numbersOf(line);
  }
  throw std::runtime_error(file.string() + " ends too early");
}

}  // namespace

TriMesh readOff(const std::filesystem::path& file) {
  std::istringstream text = wordsOf(file);
  std::string head;
  text >> head;
  if (head.find("OFF") == std::string::npos) throw std::runtime_error(file.string() + " is no OFF file");
  const std::vector<double> counts = nextNumbers(text, file);  // on the header line or below
  TriMesh mesh;
  for (auto i = static_cast<std::size_t>(counts.at(0)); i > 0; --i) {
    const std::vector<double> p = nextNumbers(text, file);
    mesh.vertices.emplace_back(p.at(0), p.at(1), p.at(2));
  }
  for (auto i = static_cast<std::size_t>(counts.at(1)); i > 0; --i) {
    const std::vector<double> face = nextNumbers(text, file);
    const auto corner = [&](std::size_t k) { return static_cast<std::int32_t>(face.at(1 + k)); };
    for (std::size_t k = 2; k < static_cast<std::size_t>(face.at(0)); ++k) {
      mesh.triangles.push_back({corner(0), corner(k - 1), corner(k)});
    }
  }
  return mesh;
}

void scaleTo(TriMesh& mesh, double size) {
  const AxisBox box = boundsOf(mesh);
  const Vec3 middle = (box.low + box.high) / 2;
  const double scale = size / (box.high - box.low).maxCoeff();
  for (Vec3& vertex : mesh.vertices) vertex = (vertex - middle) * scale;
}

void writeObj(const TriMesh& mesh, const std::filesystem::path& file) {
  std::ofstream out(file);
  char line[128];
  for (const Vec3& p : mesh.vertices) {
    std::snprintf(line, sizeof line, "v %.9g %.9g %.9g\n", p.x(), p.y(), p.z());
    out << line;
  }
  for (const TriMesh::Triangle& t : mesh.triangles)
    out << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
  if (!out.flush()) throw std::runtime_error("cannot write " + file.string());
}

std::filesystem::path packagedMesh(const std::string& name) {
  const bool assimp = name.find('/') != std::string::npos;  // OFF/Wuson
  std::filesystem::path file =
      std::filesystem::path(assimp ? PRESA_ASSIMP_MESHES : PRESA_CGAL_MESHES) / (name + ".off");
  if (std::filesystem::exists(file)) return file;
  throw std::runtime_error("no mesh " + name + " here: the Debian package " +
                           (assimp ? "assimp-testmodels" : "libcgal-demo") +
                           " is not installed, or came after the build folder. ./dev test installs it");
}

const std::vector<std::string>& realMeshes() {
  static const std::vector<std::string> names{
      "man",   "armadillo", "bear",    "turbine", "bones", "bull",  "camel",  "cow",         "dino",   "elephant",
      "femur", "hand",      "bunny00", "fandisk", "homer", "knot2", "cheese", "triceratops", "pinion", "OFF/Wuson"};
  return names;
}

TriMesh realMesh(const std::string& name) {
  TriMesh mesh = readOff(packagedMesh(name));
  scaleTo(mesh, 0.15);
  weld(mesh, 0);
  std::erase_if(mesh.triangles, [&](const TriMesh::Triangle& t) {
    const auto at = [&](std::size_t i) -> const Vec3& { return mesh.vertices[static_cast<std::size_t>(t[i])]; };
    return (at(1) - at(0)).cross(at(2) - at(0)).norm() == 0;
  });
  dropUnused(mesh);
  buildAdjacency(mesh);
  if (massProperties(mesh).volume < 0) turnInsideOut(mesh);
  return mesh;
}

}  // namespace presa::test
