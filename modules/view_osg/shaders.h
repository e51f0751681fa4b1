#pragma once
#include <osg/Program>

#include "framework/scene/scene.h"

/// GLSL 1.30 programs, compatibility profile. Everything is lit in linear RGB and in world coordinates, and encoded
/// to sRGB at the end.
namespace presa::view::shaders {

/// Bodies: key light with soft shadow, sky light with soft occlusion. Uniform `grid`: > 0 draws lines on upward faces.
/// `quick`: for a processor that draws; fewer samples of everything.
osg::ref_ptr<osg::Program> body(Material::Texture texture, bool quick);
/// Floor: as a body, fading into the background with distance; `open`: where nothing throws a shadow.
osg::ref_ptr<osg::Program> floor(Material::Texture texture, bool quick, bool open);
/// Fingertip: translucent skin, rim in the colour of the contact state (uniform `state_color`), pad the redder
/// the harder it presses (uniform `pressure`, 0 to 1).
osg::ref_ptr<osg::Program> skin();
/// HIP, arrow and links: their own colour, a little shaded; uniform `opacity`.
osg::ref_ptr<osg::Program> glyph();
/// Friction cone: translucent, denser towards grazing view; uniform `state_color`.
osg::ref_ptr<osg::Program> cone();
/// A texture (uniform `picture`) as it is; positions in clip space.
osg::ref_ptr<osg::Program> copy();
/// Vertical gradient behind everything.
osg::ref_ptr<osg::Program> background();

}  // namespace presa::view::shaders
