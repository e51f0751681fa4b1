#pragma once
#include <osg/Group>

#include "modules/view_osg/ink.h"

namespace presa::view {

/// Explains the marks of the picture in a panel at the lower right, with letters that can be read in a printed column.
/// `right`: group whose x = 0 is the right edge; `bottom`: lower edge of the panel.
void addLegend(osg::Group& right, float bottom, const Ink& ink);

}  // namespace presa::view
