#pragma once
#include <osg/StateSet>

#include "framework/scene/scene.h"

namespace presa::view {

/// Stone and earth: grain, clouds and veins out of one tile of noise in three dimensions, so that no surface has seams.
/// The tile is made here, the same in every run.
/// `state`: of the whole picture.
void addGrain(osg::StateSet& state, const Scene& scene);
/// Something is of stone or earth: there is a sky, and the ground goes on to the horizon.
bool isOutdoors(const Scene& scene);

/// Where in the tile one body was cut.
void setGrain(osg::StateSet& body, std::size_t index);

}  // namespace presa::view
