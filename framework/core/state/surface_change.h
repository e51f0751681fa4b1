#pragma once

namespace presa {

/// Whether the surfaces of the scene have changed to their other friction (Material::changed_friction). It happens once.
struct SurfaceChange {
  bool happened = false;
};

}  // namespace presa
