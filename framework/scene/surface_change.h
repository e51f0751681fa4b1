#pragma once

namespace presa {

/// Whether the surfaces have switched to their second friction (Material::changed_friction); at most once per run.
struct SurfaceChange {
  bool happened = false;  ///< from the tick in which the experiment asks for it
};

}  // namespace presa
