#include <map>

#include "framework/core/diagnostics/refuse.h"
#include "framework/scene/scene_parts.h"
#include "framework/scene/xml/schema.h"
#include "framework/scene/xml/xml.h"
#include "framework/walls/projection.h"
#include "framework/walls/walls_schema.h"

namespace presa::walls {
namespace {

using xml::Element;

enum WallsCode {
  kNoArea = 760,
  kNoRectangle = 761,
  kEyeBehind = 762,
  kNameTwice = 763,
  kNoSuchWall = 764,
  kWallsVersion = 765
};

constexpr int kWallsMajor = 1;
constexpr double kSmallestEdge = 0.01;  ///< [m]
constexpr double kSkew = 1e-3;  ///< cosine of the angle between two edges: 1 mm on a metre, as walls are measured

const xml::Schema& wallsSchema() {
  static const xml::Schema schema(schemas::walls);
  return schema;
}

Vec3 corner(const Element& element, const char* name) {
  const std::vector<double> numbers = element.numbers(name);
  return numbers.size() == 3 ? Vec3(numbers[0], numbers[1], numbers[2]) : Vec3::Zero();
}

std::string lengthText(double metres) {
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%.3g m", metres);
  return text.data();
}

void checkShape(const Wall& wall, Diagnostics& diagnostics) {
  const Vec3 lower = wall.lower_right - wall.lower_left, side = wall.upper_left - wall.lower_left;
  const double width = lower.norm(), height = side.norm();
  if (width < kSmallestEdge || height < kSmallestEdge || lower.cross(side).norm() < kSkew * width * height) {
    diagnostics.error(kNoArea, wall.where,
                      "wall " + quote(wall.name) + " has no area: its lower edge is " + lengthText(width) +
                          " long, its left edge " + lengthText(height) + ", and an edge has at least 0.01 m",
                      "lower_left, lower_right and upper_left are three corners of the picture, seen from the head");
  } else if (std::abs(lower.dot(side)) > kSkew * width * height) {
    diagnostics.error(kNoRectangle, wall.where,
                      "wall " + quote(wall.name) + " is no rectangle: the edges at lower_left are " +
                          lengthText(std::abs(lower.dot(side)) / width) + " off a right angle",
                      "a right angle within 1 mm on a metre");
  }
}

void checkEyes(const Walls& walls, const Wall& wall, Diagnostics& diagnostics) {
  for (const Vec3& eye : eyesOf(walls, walls.X_KHead)) {
    if (frustumOf(walls, wall, eye)) continue;
    diagnostics.error(kEyeBehind, wall.where,
                      "an eye of <head> is behind wall " + quote(wall.name) + ", or nearer than 0.01 m",
                      "exchange lower_left and lower_right if the wall is mirrored: they are seen from the head");
    return;
  }
}

Wall readWall(const Element& element) {
  Wall wall;
  wall.name = element.attribute("name");
  wall.lower_left = corner(element, "lower_left");
  wall.lower_right = corner(element, "lower_right");
  wall.upper_left = corner(element, "upper_left");
  wall.width = static_cast<int>(element.number("width", 0));
  wall.height = static_cast<int>(element.number("height", 0));
  wall.where = element.where();
  return wall;
}

Walls readWalls(const Element& root) {
  Walls walls;
  walls.name = root.attribute("name");
  walls.magnification = root.number("magnification", 1);
  walls.eye_distance = root.number("eye_distance", walls.eye_distance);
  walls.X_WK = readPose(root);
  for (const Element& head : root.children("head")) walls.X_KHead = readPose(head);
  for (const Element& element : root.children("wall")) walls.walls.push_back(readWall(element));
  return walls;
}

void checkWalls(const Walls& walls, Diagnostics& diagnostics) {
  std::map<std::string, int> lines;
  for (const Wall& wall : walls.walls) {
    if (const auto [first, is_new] = lines.try_emplace(wall.name, wall.where.line); !is_new)
      diagnostics.error(kNameTwice, wall.where, "two walls are called " + quote(wall.name),
                        "the first is in line " + std::to_string(first->second));
    const std::size_t before = diagnostics.errorCount();
    checkShape(wall, diagnostics);
    if (diagnostics.errorCount() == before) checkEyes(walls, wall, diagnostics);
  }
}

Walls wallsOf(std::unique_ptr<xml::Document> document, Diagnostics& diagnostics) {
  if (!document || !document->validate(wallsSchema(), diagnostics)) return {};
  const Element root = document->root();
  const std::string version = root.attribute("version");
  if (std::stoi(version) != kWallsMajor)
    diagnostics.error(kWallsVersion, root.where("version"),
                      "these walls are written in format " + quote(version) + "; this release of Presa reads 1.0",
                      "write version=\"1.0\"");
  const std::size_t before = diagnostics.errorCount();
  checkOrientation(root, diagnostics);
  for (const Element& head : root.children("head")) checkOrientation(head, diagnostics);
  if (diagnostics.errorCount() > before) return {};
  document->writeDefaults(wallsSchema());
  Walls walls = readWalls(document->root());
  walls.file = document->name();
  checkWalls(walls, diagnostics);
  return walls;
}

}  // namespace

const Wall& Walls::wall(const std::string& wanted) const {
  std::vector<std::string> names;
  for (const Wall& wall : walls) {
    if (wall.name == wanted) return wall;
    names.push_back(wall.name);
  }
  std::string all;
  for (const std::string& each : names) (all += all.empty() ? "" : ", ") += each;
  refuse(kNoSuchWall, "--wall", "no wall " + quote(wanted) + " in " + file + didYouMean(wanted, names),
         "its walls: " + all);
}

Walls loadWalls(const std::string& file, Diagnostics& diagnostics) {
  return wallsOf(xml::Document::load(file, diagnostics), diagnostics);
}

Walls parseWalls(const std::string& xml, const std::string& name, Diagnostics& diagnostics) {
  return wallsOf(xml::Document::parse(xml, name, diagnostics), diagnostics);
}

}  // namespace presa::walls
