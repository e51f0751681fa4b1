#pragma once
#include <optional>
#include <string>

#include "framework/core/diagnostics/diagnostics.h"
#include "framework/geometry/touch_mesh.h"

namespace presa::model {

struct Wanted {
  std::string file, folder;
  double scale = 1;              ///< metres for each of the file's units
  double haptic_error = 0.0001;  ///< max Hausdorff distance of the haptic mesh [m]
  int pieces = 16;               ///< max number of convex pieces
  double density = 2500;         ///< [kg/m³]
  bool overwrite = false;
};

struct Made {
  std::string name;       ///< of the body and of the files
  std::size_t triangles;  ///< of the model, welded
  TouchMesh haptic;
  TouchPieces physics;
};

/// Reads and simplifies; nothing is written. None: errors in `diagnostics`, or told to stop. The mesh must be closed.
std::optional<Made> make(const Wanted& wanted, Diagnostics& diagnostics, const GoOn& go_on);

/// E128 if a file of the result exists already, or the folder is a file.
void checkTarget(const Wanted& wanted, Diagnostics& diagnostics);
/// Writes all files, the body last, and returns its path. Throws std::system_error.
std::string write(const Wanted& wanted, const Made& made);
/// Where a scene lies that may name all files of the body: the model's folder if the output is in it or below, else the
/// folder of the output.
std::string sceneFolder(const Wanted& wanted);
/// Whether the model itself lies elsewhere, so that a scene there may not name it (E692).
bool liesOutside(const Wanted& wanted);
/// The element <body>, for a scene in sceneFolder.
std::string bodyText(const Wanted& wanted, const Made& made);
/// What was made, for people: a line for each figure.
std::string figuresText(const Made& made);

}  // namespace presa::model
