#pragma once
#include <osg/Image>
#include <osg/Texture2D>

#include "framework/geometry/model.h"

namespace presa::view {

/// Roughness: as it is in the file. Normal: the file's normals, or those of its heights. Quick: for software rendering.
enum class TextureUse { kColor, kQuickColor, kNormal, kRoughness };

/// Each picture is decoded once for all models of a file that exist at the same time, whatever their scale. The index
/// is that of Model::textures. Throws InputError: decodeTexture. Any thread.
osg::ref_ptr<osg::Texture2D> textureOf(const Model& model, int index, TextureUse use);
osg::ref_ptr<osg::Image> imageOf(const Model& model, int index);

}  // namespace presa::view
