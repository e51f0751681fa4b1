#pragma once
#include <osg/MatrixTransform>

/// Nodes that are moved, shown and hidden while the picture lives.
namespace presa::view {

inline void setShown(osg::Node& node, bool shown) { node.setNodeMask(shown ? ~0U : 0U); }

/// Puts `child` below `parent`, through a transform that may change at any frame.
inline osg::ref_ptr<osg::MatrixTransform> placed(osg::Node* child, osg::Group& parent) {
  osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform;
  transform->setDataVariance(osg::Object::DYNAMIC);
  transform->addChild(child);
  parent.addChild(transform);
  return transform;
}

}  // namespace presa::view
