#pragma once
#include <cstddef>
#include <vector>

#include "modules/dynamics_ode/body_contact.h"

namespace presa::ode {

/// Takes contacts away that lie between others in one plane: where the flat sides of several shapes lie on one flat
/// side, the corners of the whole bear what all of them would. So a body made of eight cubes lies on its four
/// corners, as one cube does. Depths that are not those of one plane keep all their contacts.
class Outline {
 public:
  /// For so many contacts of a pair of bodies; more allocate once.
  void makeRoom(std::size_t contacts) {
    points_.reserve(contacts);
    corners_.reserve(2 * contacts);
  }
  /// Removes from the contacts of two bodies, those from `first` on, what is nearer than `near` [m] to the others'
  /// outline or inside of it.
  void remove(std::vector<BodyContact>& contacts, std::size_t first, double near);

 private:
  struct Point {
    double x, y, depth;  // in the plane
    std::size_t contact;
  };
  void removeFrom(std::vector<BodyContact>& contacts, std::size_t first, std::size_t of, double near);
  void findCorners(double near);
  bool inOnePlane(double near) const;

  std::vector<Point> points_, corners_;
};

}  // namespace presa::ode
