#include "framework/grasp/words.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <optional>

namespace presa {
namespace {

constexpr double kAlong = 0.966;  // cosine of 15 degrees: a direction is named after an axis
constexpr double kNear = 0.1;     // of the length: a line goes through a point

std::string coordinates(const Vec3& v) {
  std::array<char, 64> text;
  // 0.0 added: no negative zero
  const auto rounded = [](double x) { return std::round(100 * x) / 100 + 0.0; };
  std::snprintf(text.data(), text.size(), "(%.2f, %.2f, %.2f)", rounded(v.x()), rounded(v.y()), rounded(v.z()));
  return text.data();
}

double distance(const Vec3& point, const Vec3& on_line, const Vec3& direction) {
  return (point - on_line).cross(direction).norm();
}

std::string pairWords(const GraspSnapshot& grasp, const std::vector<std::string>& names, std::size_t a, std::size_t b) {
  if (grasp.contacts.size() == 2) return "the line between the fingers";
  return "the line between " + names[a] + " and " + names[b];
}

/// The line between two contacts that the axis runs along; also one that passes them by, if `anywhere`.
std::optional<std::string> lineOfFingers(const GraspSnapshot& grasp, const std::vector<std::string>& names,
                                         const Vec3& through, const Vec3& axis, bool anywhere) {
  for (std::size_t a = 0; a < grasp.contacts.size(); ++a) {
    for (std::size_t b = a + 1; b < grasp.contacts.size(); ++b) {
      const Vec3 line = grasp.contacts[b].p - grasp.contacts[a].p;
      if (!(line.norm() > 0) || std::abs(line.normalized().dot(axis)) < kAlong) continue;
      const auto touches = [&](std::size_t i) {
        return distance(grasp.contacts[i].p, through, axis) < kNear * grasp.length;
      };
      if (anywhere || (touches(a) && touches(b))) return pairWords(grasp, names, a, b);
    }
  }
  return std::nullopt;
}

/// "up", "along the line between the fingers", "sideways", "along (0.6, 0.0, 0.8)".
std::string direction(const GraspSnapshot& grasp, const Vec3& v, const std::vector<std::string>& names,
                      const Vec3& up) {
  if (v.dot(up) > kAlong) return "up";
  if (v.dot(up) < -kAlong) return "down";
  if (const auto line = lineOfFingers(grasp, names, grasp.centre, v, true)) return "along " + *line;
  const bool level = up.norm() > 0 && std::abs(v.dot(up)) < std::sqrt(1 - kAlong * kAlong);
  return (level ? "sideways along " : "along ") + coordinates(v);
}

/// "the upright axis", "the horizontal axis (1, 0, 0)", with the point that it passes.
std::string axisWords(const GraspSnapshot& grasp, const Vec3& through, const Vec3& axis,
                      const std::vector<std::string>& names, const Vec3& up) {
  if (const auto line = lineOfFingers(grasp, names, through, axis, false)) return *line;
  std::string words = "the axis " + coordinates(axis);
  if (std::abs(axis.dot(up)) > kAlong) words = "an upright axis";
  if (distance(grasp.centre, through, axis) < kNear * grasp.length) return words + " through the centre of mass";
  for (std::size_t i = 0; i < grasp.contacts.size(); ++i) {
    if (distance(grasp.contacts[i].p, through, axis) < kNear * grasp.length) return words + " through " + names[i];
  }
  return words;
}

}  // namespace

std::string motionWords(const GraspSnapshot& grasp, const Vec6& motion, const std::vector<std::string>& names,
                        const Vec3& up) {
  const Vec3 v = motion.head<3>(), w = motion.tail<3>() / grasp.length;
  const double turning = grasp.length * w.norm(), upright = up.norm() > 0 ? 1 / up.norm() : 0;
  if (turning < kNear * motion.norm()) return "slides " + direction(grasp, v.normalized(), names, upright * up);
  const Vec3 axis = w.normalized();
  const Vec3 through = grasp.centre + w.cross(v) / w.squaredNorm();  // the axis of the screw
  const Vec3 along = v.dot(axis) * axis;
  std::string words = "turns about " + axisWords(grasp, through, axis, names, upright * up);
  // a screw that advances by more than a sixth of the length in a radian is not called a turn alone
  if (along.norm() > turning / 6) words += " and slides " + direction(grasp, along.normalized(), names, upright * up);
  return words;
}

}  // namespace presa
