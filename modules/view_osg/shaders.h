#pragma once
#include <osg/Program>

#include "framework/scene/scene.h"

/// GLSL 1.30 programs, compatibility profile. Lighting is computed in linear RGB and world coordinates, and encoded to
/// sRGB at the end.
namespace presa::view::shaders {

/// Bodies: key light with soft shadow, sky light with soft occlusion. Uniform `grid_strength`: 1 draws lines on upward
/// faces.
osg::ref_ptr<osg::Program> body(Material::Texture texture);
/// The maps that a part of a model has.
struct Maps {
  bool color = false, normal = false, roughness = false;
};
/// A part of a model (models/README.md): colour of vertices and of the maps. Uniforms `color_map`, `normal_map`, `rough_map`,
/// `relief`, `roughness`, `metallic`; quick: `map_mean`, `map_gain`. Texture coordinates 0, tangents 1.
osg::ref_ptr<osg::Program> model(const Maps& maps, bool quick);
/// Floor: like a body, fading into the background with distance.
osg::ref_ptr<osg::Program> floor(Material::Texture texture);
/// For software rendering: light computed at the vertices, soft shadows with one sample of each map. `grid`: lines on all faces;
/// `open`: the part of the floor that fades and has no shadows.
osg::ref_ptr<osg::Program> quickBody(Material::Texture texture, bool grid);
osg::ref_ptr<osg::Program> quickFloor(Material::Texture texture, bool open);
/// Fingertip: translucent skin, rim in the colour of the contact state (uniform `state_color`), pad redder with
/// pressure (uniform `pressure`, 0 to 1).
osg::ref_ptr<osg::Program> skin(bool quick);
/// HIP, arrow and links: plain colour with slight shading; uniform `opacity`.
osg::ref_ptr<osg::Program> glyph();
/// Friction cone: translucent, denser towards grazing view; uniform `state_color`.
osg::ref_ptr<osg::Program> cone();
/// Land beyond the floor, out of doors: rock where it is steep, paler with distance.
osg::ref_ptr<osg::Program> land();
/// Signed distances on a plane (texture `distances` [m], texture coordinate 0): colour of `palette` from -range to range,
/// a line each `step` [m], a strong one at zero; clear beyond the range outside; uniforms `range`, `step`, `opacity`.
osg::ref_ptr<osg::Program> slice();
/// Lines of one display colour, uniform `line_color`.
osg::ref_ptr<osg::Program> line();
/// Puts the head-up display (texture `hud`, multiplied by its opacity) over the picture (`space`); positions in clip
/// space. `smooth`: both are `larger` times the size of the picture (uniform, 1 to 2), and are averaged.
osg::ref_ptr<osg::Program> overlay(bool smooth);
/// Mean and mean square of the depths in each square of `side` texels of a depth texture (`source`), and their mean over
/// twice `half_width` texels; uniform `depth_range` [m].
osg::ref_ptr<osg::Program> moments(int side);
osg::ref_ptr<osg::Program> blur(int half_width);
/// Behind everything: out of doors sky and sea, which meet at the horizon; else a vertical gradient, uniform `crop`: lower edge and height of the rows drawn, as shares of the
/// picture's height.
osg::ref_ptr<osg::Program> background();

}  // namespace presa::view::shaders
