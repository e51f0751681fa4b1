#include "modules/xfca/places.h"

#include <algorithm>

namespace presa {
namespace {

constexpr double kSameNormal = 1 - 5e-7;  // cosine: planes up to 1 mrad apart share a push

}  // namespace

void Places::find(const GodObject::Push& push) noexcept {
  all_.clear();
  for (int i = 0; i < push.count; ++i) {
    const GodObject::Push::Part& part = push.parts[static_cast<std::size_t>(i)];
    findAlong(part);
  }
}

// In a sharp groove the handle may be above one of two planes that push the tool: what counts is the plane's own push.
void Places::findAlong(const GodObject::Push::Part& part) noexcept {
  const std::size_t first = all_.size();
  const double depth = part.depth;
  double sum = 0;
  for (const NearParts& pair : pairs_.near()) {
    if (pair.nhat_W.dot(part.nhat_W) < kSameNormal || pair.gap - GodObject::kSkin > depth) continue;
    Manifold manifold;
    pairs_.touch(pair, depth + GodObject::kSkin, manifold);
    for (int i = 0; i < manifold.count; ++i) {
      const Manifold::Point& point = manifold.points[static_cast<std::size_t>(i)];
      const double sunk = depth - (point.gap - GodObject::kSkin);
      if (!(sunk > 0) || all_.size() == first + kMaxOfPart ||
          all_.add({bodies_[pair.solid].body, point.p_W, part.nhat_W, sunk}) == nullptr)
        continue;
      sum += sunk;
    }
  }
  for (std::size_t i = first; i < all_.size(); ++i) all_[i].depth *= part.depth / sum;
}

}  // namespace presa
