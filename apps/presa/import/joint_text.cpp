#include "apps/presa/import/joint_text.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/presa/import/solids.h"

namespace presa::robot {
namespace {

using Kind = Freedom::Kind;
using std::numbers::pi;

constexpr double kSamePlace = 1e-6;  // [m]
constexpr double kSquare = 1e-6;     // cosine of two directions that count as square to each other, sine as parallel

double degrees(double radians) { return radians * 180 / pi; }

bool samePoint(const std::vector<Freedom>& freedoms) {
  return std::ranges::all_of(freedoms,
                             [&](const Freedom& f) { return (f.p_L - freedoms.front().p_L).norm() < kSamePlace; });
}

/// Which joint of Presa has these freedoms.
std::string typeOf(const std::vector<Freedom>& f) {
  const auto is = [&](std::initializer_list<Kind> kinds) { return std::ranges::equal(f, kinds, {}, &Freedom::kind); };
  if (f.empty()) return "fixed";
  if (is({Kind::kHinge})) return "hinge";
  if (is({Kind::kSlide})) return "slider";
  if (is({Kind::kBall})) return "ball";
  if (is({Kind::kHinge, Kind::kHinge}) && samePoint(f) && std::abs(f[0].dir_L.dot(f[1].dir_L)) < kSquare)
    return "universal";
  if (is({Kind::kSlide, Kind::kHinge})) return "prismatic_rotary";
  // a turn does not change a direction along its axis
  if (is({Kind::kHinge, Kind::kSlide}) && f[0].dir_L.cross(f[1].dir_L).norm() < kSquare) return "prismatic_rotary";
  if (is({Kind::kHinge, Kind::kHinge, Kind::kHinge}) && samePoint(f)) {
    const double volume = f[0].dir_L.dot(f[1].dir_L.cross(f[2].dir_L));
    if (std::abs(volume) > 0.1) return "ball";
  }
  return {};
}

class Axis {
 public:
  Axis(const Freedom& f, std::string whose, std::vector<std::string>& notes)
      : f_(f), turns_(f.kind == Kind::kHinge), whose_(std::move(whose)), notes_(notes) {}

  std::string text() const {
    std::string text = "    <axis";
    if (f_.kind != Kind::kBall) text += vectorText("dir", f_.dir_L) + limits();
    if (f_.stiffness != 0) {
      text += numberText("stiffness", f_.stiffness);
      if (f_.rest != 0) text += turns_ ? numberText("rest_deg", degrees(f_.rest)) : numberText("rest", f_.rest);
    }
    if (f_.damping != 0) text += numberText("damping", f_.damping);
    if (f_.friction != 0) text += numberText("friction", f_.friction);
    if (f_.armature != 0) notes_.push_back(whose_ + ": its armature is left out");
    return text + "/>\n";
  }

 private:
  std::string limits() const {
    if (!f_.limited) return {};
    double lower = f_.lower, upper = f_.upper;
    if (lower > 0 || upper < 0) {
      notes_.push_back(whose_ + ": it starts outside of its limits, which are widened up to the start");
      lower = std::min(lower, 0.0), upper = std::max(upper, 0.0);
    }
    if (!turns_) return numberText("lower", lower) + numberText("upper", upper);
    // rounding of a file that says 3.1416 is no more than half a turn
    constexpr double kHalfTurn = pi * (1 + 1e-4);
    std::string text;
    if (lower < -kHalfTurn || upper > kHalfTurn) notes_.push_back(whose_ + ": a limit beyond half a turn is left out");
    if (lower >= -kHalfTurn) text += numberText("lower_deg", degrees(std::max(lower, -pi)));
    if (upper <= kHalfTurn) text += numberText("upper_deg", degrees(std::min(upper, pi)));
    return text;
  }

  const Freedom& f_;
  bool turns_;
  std::string whose_;
  std::vector<std::string>& notes_;
};

/// A ball has one axis for friction and damping at most.
std::string ballText(const std::vector<Freedom>& freedoms, const std::string& whose, std::vector<std::string>& notes) {
  Freedom all;
  all.kind = Kind::kBall;
  bool stops = false, springs = false, armature = false;
  for (const Freedom& f : freedoms) {
    stops = stops || f.limited;
    springs = springs || f.stiffness != 0;
    all.damping = std::max(all.damping, f.damping);
    all.friction = std::max(all.friction, f.friction);
    armature = armature || f.armature != 0;
  }
  if (stops) notes.push_back(whose + ": the limits of a ball joint are left out");
  if (springs) notes.push_back(whose + ": the springs of a ball joint are left out");
  if (armature) notes.push_back(whose + ": its armature is left out");
  return all.damping == 0 && all.friction == 0 ? "" : Axis(all, whose, notes).text();
}

/// A link that can go anywhere in a plane, or in space, and turn there: it hangs on the world for bookkeeping alone.
bool isNearlyFree(const std::vector<Freedom>& freedoms) {
  const auto slides = std::ranges::count(freedoms, Kind::kSlide, &Freedom::kind);
  const auto hinges = std::ranges::count(freedoms, Kind::kHinge, &Freedom::kind);
  const auto balls = std::ranges::count(freedoms, Kind::kBall, &Freedom::kind);
  return (slides == 2 && hinges == 1) || (slides == 3 && (hinges == 3 || balls == 1));
}

bool hasMore(const Freedom& f) {
  return f.limited || f.stiffness != 0 || f.damping != 0 || f.friction != 0 || f.armature != 0;
}

}  // namespace

std::optional<JointText> jointOf(const Link& link, const std::string& name, const std::string& body,
                                 const std::string& to) {
  JointText joint;
  const std::vector<Freedom>& f = link.freedoms;
  if (!f.empty() && f.front().kind == Kind::kFree) {
    if (hasMore(f.front())) joint.notes.push_back("'" + body + "' moves freely: damping and armature are left out");
    return joint;
  }
  const std::string type = typeOf(f), whose = "joint '" + name + "'";
  if (type.empty() && to.empty() && isNearlyFree(f)) {
    joint.notes.push_back("'" + body + "' moves freely; in the file it has " + std::to_string(f.size()) +
                          " joints with the world" +
                          (std::ranges::any_of(f, hasMore) ? ", whose limits, springs and damping are left out" : ""));
    return joint;
  }
  if (type.empty()) return std::nullopt;
  std::string axes;
  if (type == "ball") {
    axes = ballText(f, whose, joint.notes);
  } else {
    std::vector<Freedom> ordered = f;  // the move stands before the turn
    if (type == "prismatic_rotary" && f[0].kind == Kind::kHinge) std::swap(ordered[0], ordered[1]);
    for (const Freedom& freedom : ordered) axes += Axis(freedom, whose, joint.notes).text();
  }
  // of a move and a turn, the point is that of the turn
  const Vec3 point = f.empty() ? Vec3(Vec3::Zero()) : (f.back().kind == Kind::kHinge ? f.back() : f.front()).p_L;
  joint.text = "  <joint name=\"" + name + "\" type=\"" + type + "\" body=\"" + body + "\"" +
               (to.empty() ? "" : " to=\"" + to + "\"") + (point.isZero(0) ? "" : vectorText("pos", point));
  joint.text += axes.empty() ? "/>\n" : ">\n" + axes + "  </joint>\n";
  return joint;
}

}  // namespace presa::robot
