#pragma once
#include <osg/Image>

#include "framework/geometry/model.h"

namespace presa::view {

/// A texture of a model as RGB of 8 bits, the first row at the bottom. Throws InputError: E266 it cannot be read or
/// decoded, or is no longer as it was at loading.
osg::ref_ptr<osg::Image> decodeTexture(const Model& model, const ModelTexture& texture);

/// Mean of each channel, 0 to 1.
Vec3 meanOf(const osg::Image& image);
/// Whether all pixels are grey.
bool isGrey(const osg::Image& image);
/// A normal map of heights: black to white from one pixel to the next is a slope of 45 degrees. The image repeats.
osg::ref_ptr<osg::Image> normalsOf(const osg::Image& heights);

}  // namespace presa::view
