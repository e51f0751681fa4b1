#include "modules/view_osg/help_text.h"

namespace presa::view {
namespace {

using HelpLines = std::vector<HelpLine>;

void append(HelpLines& lines, HelpLines more) { lines.insert(lines.end(), more.begin(), more.end()); }

HelpLines pairLines() {
  return {{"", "pair of fingers"},
          {"left drag", "over the ground"},
          {"Shift + left drag", "up, down and aside"},
          {"wheel", "close and open the grip; tilt a stylus"},
          {"arrows, PageUp, PageDown", "right, left, away, near, up, down"},
          {"+  -", "close and open; tilt"},
          {"q  e", "turn about the vertical"},
          {"p", "put a tool down, pick it up"},
          {"Shift + key", "a fifth of the step"}};
}

HelpLines frameLines() {
  return {{"", "user and workspace, while held"},
          {"Alt + arrows, PageUp …", "walk and turn, fly"},
          {"v", "clutch: the workspace slides back"},
          {"z  x", "zoom: coarser, finer"}};
}

HelpLines cameraLines(bool pair) {
  HelpLines lines{{"", "camera"}};
  if (pair) {
    append(lines, {{"right drag, Alt + left drag", "turn around the scene"},
                   {"middle drag", "shift"},
                   {"Ctrl + wheel", "nearer, farther"},
                   {"Ctrl + arrows, PageUp …", "fly"}});
  } else {
    append(lines, {{"left drag", "turn around the scene"},
                   {"middle drag", "shift"},
                   {"right drag, wheel", "nearer, farther"},
                   {"arrows, PageUp, PageDown", "fly"}});
  }
  append(lines, {{"h", "follow bodies and fingers again"},
                 {"c", "tell this view as --camera"},
                 {"click", "show the body card"},
                 {"double click", "look there"}});
  return lines;
}

HelpLines timeLines(bool recording) {
  HelpLines lines{{"", "time"}, {"space", "hold, go on"}, {".", "a single step"}, {"[  ]", "half and double speed"}};
  if (recording)
    append(lines, {{"drag on the bar", "to that moment"},
                   {",  <  >", "a step back, a second back and on"},
                   {"Home  End", "start and end"}});
  return lines;
}

HelpLines partLines() {
  return {{"", "show and hide"},
          {"1  2  3", "looks, haptic and physics geometry"},
          {"4", "triangles near the fingers"},
          {"5  6", "HIPs, fingertips"},
          {"7  8", "friction cones, forces"},
          {"9  0", "sleeping bodies, coordinate frames"},
          {"g  t", "plots of the last seconds, felt texture"},
          {"o  j", "offsets of the fingers, joints"},
          {"d  b  w", "devices, their deflection, their heat"},
          {"k  l  f", "contacts of a tool, its handle, the field"}};
}

}  // namespace

std::vector<HelpLine> helpLines(const Controls& controls, bool recording) {
  HelpLines lines;
  if (controls.pointer != nullptr) append(lines, pairLines());
  if (controls.frames != nullptr) append(lines, frameLines());
  append(lines, cameraLines(controls.pointer != nullptr));
  if (controls.time != nullptr) append(lines, timeLines(recording));
  append(lines, partLines());
  if (controls.undo) append(lines, {{"", "building"}, {"u", "undo the last placement"}});
  append(lines, {{"", "window"}});
  if (controls.menu != nullptr) append(lines, {{"m", "menu of all scenes"}});
  append(lines, {{"s", "save a picture"}, {"?", "this help"}, {"Esc", "stop the run"}});
  return lines;
}

}  // namespace presa::view
