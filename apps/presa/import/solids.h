#pragma once
#include <string>
#include <vector>

#include "apps/robot_reader/robot.h"

/// Solids of a robot as shapes of a scene and as meshes.
namespace presa::robot {

/// " pos=… quat=…" of an element; empty for the identity.
std::string poseText(const Pose& pose);
/// An attribute with three numbers, to nine digits, or with one, exactly.
std::string vectorText(const std::string& name, const Vec3& v);
std::string numberText(const std::string& name, double value);

/// A shape that scenes have, without its pose: <box size="…"/>. Empty for an ellipsoid and a mesh.
std::string primitiveText(const Part& part, const std::string& pose = {});
/// Where the shape stands: a plane is a slab below its surface.
Pose placeOf(const Part& part);

/// The surface of a solid in the frame of its link, closed unless a mesh of the file is open.
TriMesh surfaceOf(const Part& part, const Robot& robot);
/// Solids as one mesh, without joining them: where edges of two coincide, each is smaller than the one before by a ten
/// thousandth.
TriMesh together(const std::vector<TriMesh>& solids);
/// The surfaces of several solids as an OBJ file in which each vertex has the colour of its solid, as a display shows it.
std::string coloredObj(const std::vector<Part>& parts, const Robot& robot);

}  // namespace presa::robot
