#pragma once
#include <string>
#include <vector>

#include "apps/studies/cost/study.h"

namespace presa {
struct Scene;
}

namespace presa::cost {

/// A number of a renderer whose manifest says which values are more accurate. Its knob is called as the attribute.
struct FinerKnob {
  std::string name, path;  ///< of the attribute; after --set
  Direction finer = Direction::kUp;
  std::vector<std::string> tried;      ///< values for a study, coarse to fine; empty: none by itself
  double value = 0;                    ///< of the scene; 0: the renderer chooses
  double above = 0, min = 0, max = 0;  ///< bounds: exclusive, inclusive; infinite: none
};

/// Those of the renderers of fingertips and tools that the scene uses.
std::vector<FinerKnob> finerKnobs(const Scene& scene);

/// Those of all renderers that are installed, with their default values.
std::vector<FinerKnob> allFinerKnobs();

/// Study::finer: the values of the scene and of the factors, and then one for each level, twice as fine as the one
/// before, within the bounds. Without knobs whose value the renderer chooses and that no factor varies.
std::vector<std::vector<std::string>> finerSets(const Scene& scene, const std::vector<Factor>& factors,
                                                std::size_t levels);

}  // namespace presa::cost
