#pragma once
#include <array>
#include <string>
#include <vector>

#include "framework/session/shown_parts.h"

namespace presa::view {

/// Visible parts of the picture. Default: bodies, HIPs, fingertips, cones, forces and devices.
class ShownParts {
 public:
  ShownParts() = default;
  /// The default plus `names`; a name with the prefix "no-" hides the part. Throws InputError E704 for an unknown part.
  explicit ShownParts(const std::vector<std::string>& names);

  bool operator==(const ShownParts&) const = default;
  bool operator[](ShownPart part) const { return shown_[static_cast<std::size_t>(part)]; }
  void set(ShownPart part, bool shown) { shown_[static_cast<std::size_t>(part)] = shown; }
  void toggle(ShownPart part) { shown_[static_cast<std::size_t>(part)] = !(*this)[part]; }

 private:
  std::array<bool, kShownPartNames.size()> shown_{true,  false, false, false, true, true,  true,  true,  false, false,
                                                  false, false, false, false, true, false, false, false, false, false};
};

}  // namespace presa::view
