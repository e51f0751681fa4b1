#pragma once
#include <osg/Group>
#include <osg/MatrixTransform>
#include <vector>

#include "modules/view_osg/finger_view.h"
#include "modules/view_osg/shown_parts.h"
#include "modules/view_osg/view_frame.h"

namespace presa::view {

/// `--show points`: the places at which bodies hold the tools, each with its force; `--show coupling`: where the handle of
/// each tool is, as a faint copy of the tool, and the way from the tool's origin to it. Nodes exist once they are shown.
class ToolMarks {
 public:
  /// Both must outlive this.
  ToolMarks(const World& world, osg::Group& space) : world_(world), space_(space) {}
  void show(const ShownParts& parts, const ViewFrame& frame, const std::vector<FingerView>& fingers);

 private:
  struct Arrow {
    osg::ref_ptr<osg::MatrixTransform> place, shaft, head;
  };
  struct Handle {
    osg::ref_ptr<osg::MatrixTransform> copy, way;
  };
  void showPoints(const ViewFrame& frame);
  void showHandles(const std::vector<FingerView>& fingers);
  Arrow& arrow(std::size_t i);

  const World& world_;
  osg::Group& space_;
  osg::ref_ptr<osg::Group> points_, handles_;  ///< null: never shown
  std::vector<Arrow> arrows_;
  std::vector<Handle> handle_of_;  ///< by device role; null nodes: a fingertip
};

}  // namespace presa::view
