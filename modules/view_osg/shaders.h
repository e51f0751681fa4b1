#pragma once
#include <osg/Program>

#include "framework/scene/scene.h"

/// GLSL 1.30 programs, compatibility profile. Lighting is computed in linear RGB and world coordinates, and encoded to
/// sRGB at the end.
namespace presa::view::shaders {

/// Bodies: key light with soft shadow, sky light with soft occlusion. Uniform `grid`: > 0 draws lines on upward faces.
/// `quick`: fewer samples, for software rendering.
osg::ref_ptr<osg::Program> body(Material::Texture texture, bool quick);
/// Floor: like a body, fading into the background with distance; `open`: without shadows.
osg::ref_ptr<osg::Program> floor(Material::Texture texture, bool quick, bool open);
/// Fingertip: translucent skin, rim in the colour of the contact state (uniform `state_color`), pad redder with
/// pressure (uniform `pressure`, 0 to 1).
osg::ref_ptr<osg::Program> skin();
/// HIP, arrow and links: plain colour with slight shading; uniform `opacity`.
osg::ref_ptr<osg::Program> glyph();
/// Friction cone: translucent, denser towards grazing view; uniform `state_color`.
osg::ref_ptr<osg::Program> cone();
/// Copies a texture (uniform `picture`); positions in clip space.
osg::ref_ptr<osg::Program> copy();
/// Vertical gradient behind everything.
osg::ref_ptr<osg::Program> background();

}  // namespace presa::view::shaders
