#pragma once
#include <vector>

#include "framework/scene/scene.h"
#include "framework/scene/xml/xml.h"

/// Reading and checking `<joint>` elements: steps of loading a scene.
namespace presa {

/// Whether axis i of a joint of that type turns; else it slides.
bool axisTurns(JointType type, std::size_t i);
/// Reads the joints of a document without errors.
std::vector<Joint> readJoints(const xml::Element& root, const std::vector<Body>& bodies);

/// Checks the `<joint>` elements of a document, one by one. E203 duplicate name; E229 an unknown body, or bodies that
/// it cannot join; E230 axes or attributes that its type does not have; E231 an axis without direction, or two that do
/// not fit; E232 limits that contradict each other or the start pose; E235 what the engine's own solver lacks.
void checkJoints(const xml::Element& root, Diagnostics& diagnostics);

/// Checks joints that close a loop, in the start pose. E233: a loop that cannot move, such as hinges whose axes do not
/// meet or run parallel.
void checkJointLoops(const Scene& scene, Diagnostics& diagnostics);

}  // namespace presa
