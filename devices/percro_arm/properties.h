#pragma once
#include <span>
#include <string_view>

#include "devices/percro_arm/parameters.h"

namespace presa::percro {

/// A property of the arm that a rig may take away, to see what it does to a task.
struct Property {
  std::string_view name, about;
  void (*remove)(Parameters&);
};
/// compliance, encoders, friction, inertia, bandwidth, heat.
std::span<const Property> properties();

}  // namespace presa::percro
