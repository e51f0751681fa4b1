#pragma once
#include <cstdint>
#include <vector>

#include "modules/dynamics_ode/body_contact.h"
#include "modules/dynamics_ode/body_set.h"
#include "modules/dynamics_ode/convex/outline.h"

namespace presa::ode {

/// Takes contacts away that only the joints between the shapes of one body make. A ball that rolls over the seam of two
/// boxes in line meets the next box's edge, a block its side, although that edge and side lie inside the body: both
/// would be thrown up or stopped. A contact goes when its point lies at another shape of the same body and the contact
/// with that shape, in another direction, keeps the two shapes as far apart already. Of equal contacts the deepest
/// stays, and of those in one plane the outline (outline.h).
class InnerEdges {
 public:
  explicit InnerEdges(const BodySet& bodies);
  /// Starts with a pair of bodies; then every pair of their shapes in the order of its contacts.
  void begin() { meetings_.clear(); }
  void add(std::size_t shape_A, std::size_t shape_B, std::size_t contacts) {
    if (contacts > 0) meetings_.push_back({shape_A, shape_B, contacts});
  }
  /// Removes those of `contacts` from `first` on.
  void remove(const BodySet& bodies, std::vector<BodyContact>& contacts, std::size_t first);

 private:
  struct Meeting {
    std::size_t shape_A, shape_B, contacts;
  };
  struct Candidate {
    std::size_t contact;  // index
    std::uint32_t meeting;
    bool stays;
  };
  bool isNeedless(const BodySet& bodies, const std::vector<BodyContact>& contacts, const Candidate& one,
                  const Candidate& other, double near) const;
  bool meetsJoint(const BodySet& bodies, const std::vector<BodyContact>& contacts, const Candidate& one,
                  const Meeting& other, double near) const;

  std::vector<Meeting> meetings_;
  std::vector<Candidate> candidates_;
  Outline outline_;
};

}  // namespace presa::ode
