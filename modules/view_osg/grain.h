#pragma once
#include <osg/StateSet>

#include "framework/scene/scene.h"

namespace presa::view {

/// Stone and earth: grain, clouds and veins from one three-dimensional tile of noise, so that no surface has seams. The
/// tile is generated here and is the same in every run. `state`: state set of the whole picture.
void addGrain(osg::StateSet& state, const Scene& scene);
/// Whether something is of stone or earth; the picture then has a sky, and the ground extends to the horizon.
bool isOutdoors(const Scene& scene);

/// Sets the place in the tile from which a body is cut.
void setGrain(osg::StateSet& body, std::size_t index);

}  // namespace presa::view
