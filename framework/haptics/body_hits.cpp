#include "framework/haptics/body_hits.h"

#include <algorithm>

#include "framework/scene/manifest.h"

namespace presa {

void BodyHits::add(const BodyHit& hit) noexcept {
  if (ring_.empty()) return;
  const std::uint64_t kept = std::min<std::uint64_t>(count_, ring_.size());
  for (std::uint64_t n = 1; n <= kept; ++n) {
    const BodyHit& before = ring_[(count_ - n) % ring_.size()];
    if (hit.time - before.time > 2 * kSamePair) break;  // they are in order, to a step
    const bool same = before.otherThan(hit.A) == hit.B;
    if (same && hit.time - before.time < kSamePair && hit.speed <= before.speed) return;
  }
  ring_[count_++ % ring_.size()] = hit;
}

bool needsBodyHits(const Scene& scene) {
  return std::ranges::any_of(scene.plugin_elements, [](const PluginElement& element) {
    const Manifest* manifest = findManifest(element.plugin);
    return manifest != nullptr && manifest->needs_hits;
  });
}

}  // namespace presa
