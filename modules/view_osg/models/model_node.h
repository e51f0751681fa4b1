#pragma once
#include <memory>
#include <osg/Node>

#include "framework/geometry/model.h"

namespace presa::view {

/// A model in its own frame, with its programs, textures and levels of detail. `quick`: for software rendering. What is
/// costly is made once for all nodes of a model that exist at the same time. Throws InputError: decodeTexture.
osg::ref_ptr<osg::Node> modelNode(const std::shared_ptr<const Model>& model, bool quick);

}  // namespace presa::view
