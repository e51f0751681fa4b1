#pragma once
#include <memory>
#include <string>
#include <vector>

#include "framework/scene/world.h"

namespace presa {

/// Shares of the material's stiffness and of its coefficients of friction, 0 to 1.
struct MaterialShare {
  double stiffness = 1, friction = 1;
};

/// The shares of a mesh by vertex: all <material_part> and <material_colour> of the body's material together. Between
/// the corners of a triangle they are interpolated barycentrically, so they are continuous over the surface.
struct MeshShares {
  std::shared_ptr<const TriMesh> mesh;   ///< the body's haptic one
  std::vector<MaterialShare> of_vertex;  ///< as mesh->vertices
  std::vector<std::string> parts;        ///< materials that the file gives to triangles
  bool has_colours = false;              ///< the file has colours of vertices
  bool grades_stiffness = false,         ///< some vertex has a share of the stiffness below 1
      grades_friction = false;           ///< likewise of the friction
};

/// The elements of this plug-in in the material of `element`.
std::vector<const PluginElement*> elementsBeside(const PluginElement& element, const World& world);

/// The shares of the body of an element, from the file of its haptic mesh. Objects that ask for the same ones, as long
/// as one of them lives, get the same table. Throws std::invalid_argument: the body is no mesh from a file;
/// the file has changed; the stiffness changes too steeply. Thread: main or view.
std::shared_ptr<const MeshShares> sharesOf(const PluginElement& element, const World& world);

}  // namespace presa
