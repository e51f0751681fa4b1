#pragma once
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/scene/xml/xml.h"

namespace presa::robot {

/// Something of the file that the scene has not.
struct LeftOut {
  std::string what;      ///< "<actuator>"
  SourceLocation where;  ///< of the first
  std::size_t count = 1;
};

/// Collects what is left out, one entry for each thing.
class LeftOuts {
 public:
  void add(const std::string& what, const SourceLocation& where);
  const std::vector<LeftOut>& all() const { return all_; }

 private:
  std::vector<LeftOut> all_;
};

struct SourceOptions {
  bool free_base = false;  ///< the root link of a URDF moves freely; else it is fixed to the world
};

/// A URDF or MJCF file, made ready for the robot reader: includes are in their places, meshes are OBJ files in a scratch
/// folder, and what Presa's scenes do not have is taken out. All files are opened through framework/input.
struct Source {
  std::string name;                         ///< of the model, as the file says, else of the file
  std::map<std::string, double> carried;    ///< share of a link's weight that MJCF's gravcomp takes, by its name
  std::string root;                         ///< link of a URDF that is fixed to the world; empty: none
  std::unique_ptr<xml::Document> document;  ///< as it is written to `file`
  std::filesystem::path file;               ///< in the scratch folder
  LeftOuts left_out;
};

/// None: errors in `diagnostics`. E101 to E107 as for every XML file, E130 neither URDF nor MJCF, E131 what MuJoCo would
/// not read, E132 a mesh or include that is not there, E692 a file outside of the allowed folders, E30x a mesh that cannot
/// be read. Throws std::system_error if the scratch folder cannot be written. Thread: main.
std::optional<Source> prepare(const std::string& file, const std::filesystem::path& scratch,
                              const SourceOptions& options, Diagnostics& diagnostics);

/// Where the element on this line of Source::file was read.
SourceLocation whereOf(const Source& source, int line);
/// Where a link, or a body, of that name was read.
SourceLocation whereIsLink(const Source& source, const std::string& name);

}  // namespace presa::robot
