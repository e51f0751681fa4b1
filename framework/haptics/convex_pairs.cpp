#include "framework/haptics/convex_pairs.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace presa {
namespace {

constexpr double kApart = 2e-5;  // gap at which the plane of an overlap is looked for [m]

// Along the plane of the last tick, or that of a face, the tool is taken out of the body, and a little farther; from
// there the shortest way has a direction, which follows tool and body as they turn.
SupportingPlane planeOfOverlap(const PlacedSupport& body, const PlacedSupport& tool, const Vec3& nhat_last,
                               DistanceMemory& memory) noexcept {
  const SupportingPlane last =
      nhat_last.isZero() ? planeOfFaces(body, tool, memory) : planeAlong(body, tool, nhat_last, memory);
  const Vec3 out = (kApart - last.gap) * last.nhat_AB;
  memory.nhat_AB = last.nhat_AB;
  const ConvexDistance found = distance(body, {tool.support, tool.R, tool.p + out}, 2 * kApart, memory);
  const double gap = found.gap - out.dot(found.nhat_AB);
  if (found.kind != ConvexDistance::Kind::kNearest || gap <= last.gap) return last;
  return {found.nhat_AB, gap, found.on_a, found.on_b - out};
}

}  // namespace

ConvexPairs::ConvexPairs(const ConvexSolid& tool, const std::vector<ConvexSolid>& bodies)
    : tool_(tool), bodies_(bodies), X_WB_(bodies.size()), near_(kMaxNear) {
  for (const ConvexSolid& body : bodies) {
    first_part_.push_back(bodies_in_W_.size());
    for (const ConvexPart& part : body.parts) bodies_in_W_.push_back({part.support.hull()});
  }
  for (const ConvexPart& part : tool.parts) tool_in_W_.push_back({part.support.hull()});
  centres_W_.resize(bodies_in_W_.size());
  memories_.resize(bodies_in_W_.size() * tool.parts.size());
  // the stand-ins of cylinders take their memory
  const Hull cylinder = cylinderHull(1, 4);
  for (const Vec3& away : {Vec3(3, 0, 0), Vec3(1, 0, 5)}) {
    std::array<CylinderTurn, 2> turns;
    facing_.of({cylinder, {}, nullptr, &turns[0]}, {cylinder, {away, Quat::Identity()}, nullptr, &turns[1]});
  }
}

void ConvexPairs::place(const Touchables& touchables) noexcept {
  ++ticks_;
  ++poses_;
  separated_ = -1;
  for (std::size_t s = 0; s < bodies_.size(); ++s) {
    X_WB_[s] = touchables.frameOf(bodies_[s].body);
    for (std::size_t p = 0; p < bodies_[s].parts.size(); ++p)
      centres_W_[first_part_[s] + p] = X_WB_[s] * bodies_[s].parts[p].centre_A;
  }
}

void ConvexPairs::list(const NearParts& pair) noexcept {
  if (near_.add(pair) != nullptr) return;
  NearParts* farthest = std::max_element(near_.begin(), near_.end(),
                                         [](const NearParts& a, const NearParts& b) { return a.gap < b.gap; });
  if (pair.gap < farthest->gap) *farthest = pair;
}

bool ConvexPairs::gather(const Pose& X_WT, double reach) noexcept {
  near_.clear();
  separated_ = -1;
  for (std::size_t t = 0; t < tool_.parts.size(); ++t) {
    const Vec3 centre_W = X_WT * tool_.parts[t].centre_A;
    for (std::size_t s = 0; s < bodies_.size(); ++s) {
      for (std::size_t p = 0; p < bodies_[s].parts.size(); ++p) {
        const double radii = tool_.parts[t].reach + bodies_[s].parts[p].reach, within = reach + radii;
        const double apart = (centres_W_[first_part_[s] + p] - centre_W).squaredNorm();
        if (apart > within * within) continue;
        list({.tool_part = static_cast<std::uint32_t>(t),
              .solid = static_cast<std::uint32_t>(s),
              .part = static_cast<std::uint32_t>(p),
              .gap = std::sqrt(apart) - radii});
      }
    }
  }
  return near_.lost() == 0;
}

double ConvexPairs::clearance(const Pose& X_WT) const noexcept {
  double least = std::numeric_limits<double>::infinity();
  for (const ConvexPart& own : tool_.parts) {
    const Vec3 centre_W = X_WT * own.centre_A;
    for (std::size_t s = 0; s < bodies_.size(); ++s) {
      for (std::size_t p = 0; p < bodies_[s].parts.size(); ++p) {
        const double apart = (centres_W_[first_part_[s] + p] - centre_W).norm();
        least = std::min(least, apart - own.reach - bodies_[s].parts[p].reach);
      }
    }
  }
  return least;
}

// Coordinates count from the tool's origin, so that they keep their digits far from the world's.
PlacedSupport ConvexPairs::placedBody(const NearParts& pair) const noexcept {
  const ConvexPart& part = bodies_[pair.solid].parts[pair.part];
  const Pose X_WP = X_WB_[pair.solid] * part.X_AP;
  return {part.support, X_WP.q.toRotationMatrix(), X_WP.p - X_WT_.p};
}

PlacedSupport ConvexPairs::placedTool(const NearParts& pair) const noexcept {
  const ConvexPart& part = tool_.parts[pair.tool_part];
  return {part.support, (X_WT_.q * part.X_AP.q).toRotationMatrix(), X_WT_.q * part.X_AP.p};
}

void ConvexPairs::separate(const Pose& X_WT, double beyond) noexcept {
  const bool is_known = beyond <= separated_ && X_WT.p == X_WT_.p && X_WT.q.coeffs() == X_WT_.q.coeffs();
  if (is_known) return;
  for (NearParts& pair : near_) separate(pair, X_WT, beyond);
  separated_ = beyond;
}

void ConvexPairs::follow(const Vec3& step, double within) noexcept {
  const Pose moved{X_WT_.p + step, X_WT_.q};
  const double range = separated_;
  for (NearParts& pair : near_) {
    pair.gap += pair.nhat_W.dot(step);
    pair.on_tool_W += step;
    if (pair.gap <= within) separate(pair, moved, within);
  }
  X_WT_ = moved;
  ++poses_;
  separated_ = range;
}

void ConvexPairs::separate(NearParts& pair, const Pose& X_WT, double beyond) noexcept {
  X_WT_ = X_WT;
  ++poses_;
  separated_ = -1;
  const PlacedSupport body = placedBody(pair), tool = placedTool(pair);
  Memory& memory = memoryOf(pair);
  const bool is_fresh = memory.tick + 1 >= ticks_;
  const Vec3 last = is_fresh ? memory.distance.nhat_AB : Vec3(Vec3::Zero());
  const ConvexDistance found = distance(body, tool, beyond, memory.distance);
  memory.tick = ticks_;
  SupportingPlane plane{found.nhat_AB, found.gap, found.on_a, found.on_b};
  if (found.kind == ConvexDistance::Kind::kOverlap) {
    plane = planeOfOverlap(body, tool, last, memory.distance);
  } else if (found.nhat_AB.dot(last) < 0) {
    // within a tick it does not get around a part: it was turned, or the part moved, through it
    const SupportingPlane before = planeAlong(body, tool, last, memory.distance);
    if (before.gap < 0) plane = before;
  }
  memory.distance.nhat_AB = plane.nhat_AB;
  pair.nhat_W = plane.nhat_AB;
  pair.gap = plane.gap;
  pair.on_body_W = X_WT.p + plane.on_a;
  pair.on_tool_W = X_WT.p + plane.on_b;
}

void ConvexPairs::touch(const NearParts& pair, double margin, Manifold& out) noexcept {
  const PlacedSupport body = placedBody(pair), tool = placedTool(pair);
  const Pose X_body{body.p, X_WB_[pair.solid].q * bodies_[pair.solid].parts[pair.part].X_AP.q},
      X_tool{tool.p, X_WT_.q * tool_.parts[pair.tool_part].X_AP.q};
  const Hull &body_hull = body.support.hull(), &tool_hull = tool.support.hull();
  const auto placed = [&](InWorld& in_W, const Hull& hull, const Pose& X) {
    if (in_W.pose != poses_) presa::place(hull, X, in_W.hull);
    in_W.pose = poses_;
    return &in_W.hull;
  };
  const Hull *of_body = placed(bodies_in_W_[first_part_[pair.solid] + pair.part], body_hull, X_body),
             *of_tool = placed(tool_in_W_[pair.tool_part], tool_hull, X_tool);
  std::array<CylinderTurn, 2>& turns = memoryOf(pair).turns;
  const auto [a, b] = facing_.of({body_hull, X_body, of_body, &turns[0]}, {tool_hull, X_tool, of_tool, &turns[1]});
  touchAlong(*a, *b, pair.nhat_W, pair.on_body_W - X_WT_.p, pair.on_tool_W - X_WT_.p, margin, out);
  for (int i = 0; i < out.count; ++i) out.points[static_cast<std::size_t>(i)].p_W += X_WT_.p;
}

}  // namespace presa
