#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "devices/percro_arm/parameters.h"

namespace presa::percro {

/// A property of the arm that a rig may take away, to see what it does to a task.
struct Property {
  std::string_view name, about;
  void (*remove)(Parameters&);
};
/// compliance, encoders, friction, inertia, bandwidth, heat (with the torque limits).
std::span<const Property> properties();
/// Removes the properties whose names are in `words`; returns the words that are none.
std::vector<std::string> removeProperties(const std::string& words, Parameters& arm);

}  // namespace presa::percro
