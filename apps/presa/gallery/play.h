#pragma once
#include <cstddef>
#include <vector>

#include "apps/presa/gallery/entries.h"
#include "apps/presa/run/run_scene.h"

namespace presa::gallery {

/// Runs the scene `first`. In a window, whose menu offers all entries, a scene that comes to its end begins again, until
/// the user chooses another one or stops; with a duration (--for) it ends then. Files that `arguments` asks for belong to the
/// first run alone. `by_hand`: mouse and keys move the fingers. Returns the exit status: the worst of all runs. Thread: main.
int play(const std::vector<Entry>& entries, std::size_t first, bool by_hand, RunArguments arguments);

}  // namespace presa::gallery
