#include "modules/dynamics_ode/convex/sweep.h"

#include <algorithm>
#include <numbers>

namespace presa::ode {
namespace {

// in relation to the thinner body
constexpr double kShortWay = 0.25;       // movement that its contacts cover
constexpr double kMaxOverlap = 0.3;      // at which bodies stop
constexpr double kMinAdvance = 0.15;     // between two looks, when they are as close as that
constexpr double kRoundedUp = 1 + 1e-9;  // a bound
constexpr int kMaxLooks = 64;            // then they stop where they were seen apart last
constexpr int kRounds = 8;               // a body that stops is in the way of those behind it

double widthOf(const Hull& hull) {
  if (hull.cylinder) return std::min(2 * hull.cylinder->radius, hull.cylinder->length);
  if (hull.faces.empty()) return 2 * hull.radius;
  double width = 1e300;
  for (const Hull::Face& face : hull.faces) {
    double lowest = 1e300;
    for (const Vec3& v : hull.vertices) lowest = std::min(lowest, face.nhat.dot(v));
    width = std::min(width, face.offset - lowest);
  }
  return width;
}

double rimOf(const Hull& hull, const Pose& X_CmG) {
  double rim = 0;
  for (const Vec3& v : hull.vertices) rim = std::max(rim, (X_CmG * v).norm());
  return rim + hull.radius;
}

Vec3 rotationVector(const Quat& q) {
  const Eigen::AngleAxisd turn(q.w() < 0 ? Quat(-q.coeffs()) : q);
  return turn.angle() * turn.axis();
}

}  // namespace

Sweep::Sweep(const BodySet& bodies)
    : shapes_(bodies.shapeCount()),
      first_convex_(bodies.size(), kNone),
      rims_(bodies.size()),
      ways_(bodies.size()),
      broad_phase_(bodies) {
  std::size_t edges = 0, faces = 0;
  for (std::size_t i = 0; i < shapes_.size(); ++i) {
    if (bodies.hullOf(i) == nullptr) continue;
    const std::size_t body = bodies.bodyOf(i);
    const Hull& hull = *bodies.hullOf(i);
    const Pose X_CmG = bodies.moves(body) ? bodies.centrePose(body).inverse() * bodies.poseOf(i) : Pose();
    shapes_[i] = {&hull, X_CmG, body, widthOf(hull), bodies.moves(body) ? rimOf(hull, X_CmG) : 0};
    if (first_convex_[body] == kNone) first_convex_[body] = i;
    thinnest_ = std::min(thinnest_, shapes_[i].width);
    rims_[body] = std::max(rims_[body], shapes_[i].rim);
    edges = std::max(edges, hull.edges.size());
    faces = std::max(faces, hull.faces.size());
    for (Hull& placed : placed_) presa::place(hull, Pose(), placed);  // takes its memory
  }
  maker_.makeRoom(edges, faces);
}

// By a bound of the angle, without its arc tangent: true when all bodies move little.
bool Sweep::moveLittle(const BodySet& bodies) const {
  const double little = kShortWay * thinnest_ / (2 * kRoundedUp);
  for (std::size_t i = 0; i < rims_.size(); ++i) {
    if (first_convex_[i] == kNone || !bodies.awake(i)) continue;
    const BodySet::Motion &begin = bodies.motionAtBegin(i), end = bodies.motion(i);
    const double sine = (end.q_WB * begin.q_WB.conjugate()).vec().norm();  // of half the angle
    const double way = (end.p_WCm - begin.p_WCm).norm() + rims_[i] * std::numbers::pi * sine;
    if (way >= little) return false;  // one that is not a number is none: its body is frozen after this
  }
  return true;
}

void Sweep::measureWays(const BodySet& bodies) {
  for (std::size_t i = 0; i < ways_.size(); ++i) {
    Way& way = ways_[i] = Way();
    if (first_convex_[i] == kNone || !bodies.awake(i)) continue;
    const BodySet::Motion &begin = bodies.motionAtBegin(i), end = bodies.motion(i);
    way.begin = {begin.p_WCm, begin.q_WB};
    way.shift = end.p_WCm - begin.p_WCm;
    way.turn = rotationVector(end.q_WB * begin.q_WB.conjugate());
  }
}

double Sweep::travel(std::size_t A, std::size_t B) const {
  const Way &way_A = ways_[shapes_[A].body], &way_B = ways_[shapes_[B].body];
  return (way_B.shift - way_A.shift).norm() + shapes_[A].rim * way_A.turn.norm() + shapes_[B].rim * way_B.turn.norm();
}

Pose Sweep::geomPose(const BodySet& bodies, std::size_t i, double s) const {
  const std::size_t body = shapes_[i].body;
  if (!bodies.awake(body)) return bodies.poseOf(i);
  const Way& way = ways_[body];
  s = std::min(s, way.end);
  const double angle = way.turn.norm();
  const Quat turned = angle > 0 ? Quat(Eigen::AngleAxisd(s * angle, way.turn / angle)) : Quat(Quat::Identity());
  return Pose{way.begin.p + s * way.shift, turned * way.begin.q} * shapes_[i].X_CmG;
}

Separation Sweep::separation(const BodySet& bodies, std::size_t A, std::size_t B, double s) {
  const Pose X_A = geomPose(bodies, A, s), X_B = geomPose(bodies, B, s);
  std::array<CylinderTurn, 2> turns;
  const Hull &a = *shapes_[A].hull, &b = *shapes_[B].hull;
  if (!a.cylinder) presa::place(a, X_A, placed_[0]);
  if (!b.cylinder) presa::place(b, X_B, placed_[1]);
  const auto [facing_a, facing_b] = facing_.of({a, X_A, &placed_[0], &turns[0]}, {b, X_B, &placed_[1], &turns[1]});
  return maker_.separate(*facing_a, *facing_b);
}

// The part of their ways that both may go. Along the normal of one look the gap shrinks no faster than `closing`, and
// the gap along the best normal is at least that.
double Sweep::follow(const BodySet& bodies, std::size_t A, std::size_t B) {
  const Way &way_A = ways_[shapes_[A].body], &way_B = ways_[shapes_[B].body];
  const double width = std::min(shapes_[A].width, shapes_[B].width),
               turning = shapes_[A].rim * way_A.turn.norm() + shapes_[B].rim * way_B.turn.norm();
  const double end = std::max(way_A.end, way_B.end);
  Separation apart = separation(bodies, A, B, 0);
  // those that overlap more already may not go deeper
  const double lowest = std::min(-kMaxOverlap * width, apart.gap - 0.5 * kMinAdvance * width);
  double s = 0, good = 0;
  for (int look = 0; look < kMaxLooks; ++look) {
    const double closing = std::max(0.0, -(way_B.shift - way_A.shift).dot(apart.nhat_AB_W)) + turning;
    const double free = apart.gap - lowest;
    if (free >= closing * (end - s)) return end;
    good = s + free / closing;
    s = std::min(end, s + std::max(free, kMinAdvance * width) / closing);
    apart = separation(bodies, A, B, s);
    if (apart.gap < lowest) return good;
    good = s;
    if (s >= end) return end;
  }
  return good;
}

// True when one of them goes less far than it would have.
bool Sweep::stopShapes(const BodySet& bodies, std::size_t A, std::size_t B) {
  if (shapes_[A].hull == nullptr || shapes_[B].hull == nullptr) return false;
  if (travel(A, B) <= kShortWay * std::min(shapes_[A].width, shapes_[B].width)) return false;
  const double end = follow(bodies, A, B);
  bool stopped = false;
  for (const std::size_t i : {shapes_[A].body, shapes_[B].body}) {
    if (!bodies.awake(i) || ways_[i].end <= end) continue;
    ways_[i].end = end;
    stopped = true;
  }
  return stopped;
}

bool Sweep::stopPair(const BodySet& bodies, const BroadPhase::Pair& pair) {
  const BodySet::Shapes a = bodies.shapes(pair.first), b = bodies.shapes(pair.second);
  const bool several = a.count * b.count > 1;
  bool stopped = false;
  for (std::size_t s = a.first; s < a.first + a.count; ++s) {
    for (std::size_t t = b.first; t < b.first + b.count; ++t) {
      if (several && !bodies.shapesAreNear(s, t, travel(s, t))) continue;
      stopped = stopShapes(bodies, s, t) || stopped;
    }
  }
  return stopped;
}

void Sweep::stopShort(BodySet& bodies, double h) {
  if (moveLittle(bodies)) return;
  const std::vector<BroadPhase::Pair>& pairs = broad_phase_.find(bodies, h, 0);
  if (pairs.empty()) return;
  measureWays(bodies);
  bool stopped = true;
  for (int round = 0; stopped && round < kRounds; ++round) {
    stopped = false;
    for (const BroadPhase::Pair& pair : pairs) stopped = stopPair(bodies, pair) || stopped;
  }
  for (std::size_t i = 0; i < ways_.size(); ++i) {
    if (ways_[i].end >= 1) continue;
    const std::size_t shape = first_convex_[i];
    const Pose X_WG = geomPose(bodies, shape, 1);
    const Pose X_WCm = X_WG * shapes_[shape].X_CmG.inverse();
    bodies.stopAt(i, X_WCm.p, X_WCm.q);
    ++stops_;
  }
}

}  // namespace presa::ode
