#pragma once
#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "apps/presa/import/source.h"
#include "framework/core/math/spatial.h"

namespace presa::robot {

/// The steps of prepare(): source.cpp has those of both formats, source_urdf.cpp and source_mjcf.cpp their own.
class Preparation {
 public:
  Preparation(const std::string& file, std::filesystem::path scratch, const SourceOptions& options,
              Diagnostics& diagnostics);
  std::optional<Source> run();

 private:
  using Names = std::set<std::string>;

  void urdf(xml::Element root);
  void urdfLink(const xml::Element& link);
  void urdfMesh(xml::Element mesh);
  void urdfJoint(const xml::Element& joint);
  /// Fixed to the world, or free where the user says so.
  void urdfBase(xml::Element root);
  /// Where a file that a URDF names lies; empty with an error.
  std::string urdfFile(const std::string& name, const SourceLocation& where);

  void mjcf(xml::Element root);
  void mjcfIncludes(const xml::Element& in);
  bool mjcfInclude(const xml::Element& include);
  void mjcfOptions(const xml::Element& root);
  void mjcfAssets(const xml::Element& root);
  void mjcfBody(xml::Element body);
  void mjcfDefaults(const xml::Element& of);

  /// Reads and sets what both formats have in <compiler>; its settings of folders are used up here.
  xml::Element compiler(xml::Element root);
  /// Takes out the children of other names, and lists them.
  void keepOnly(const xml::Element& of, const Names& names);
  void leaveOut(xml::Element element);
  void leaveOut(xml::Element of, const std::string& attribute, const std::string& what);
  /// The mesh as an OBJ file, so that only Presa's own reader opens the file; empty with an error.
  std::string meshFile(const std::string& path, const SourceLocation& where, const Vec3& scale = Vec3::Ones());
  void refuseOddNumbers(const xml::Element& element);
  bool fail(int code, const SourceLocation& where, const std::string& what, const std::string& help = {});

  const std::string& file_;
  std::filesystem::path scratch_;
  const SourceOptions& options_;
  Diagnostics& diagnostics_;
  Source source_;
  /// File and scale -> its OBJ in the scratch folder.
  std::map<std::pair<std::string, std::array<double, 3>>, std::string> meshes_;
  std::string mesh_folder_;
  bool strip_path_ = false;
  std::set<std::string> included_;  // each file once
  std::size_t elements_ = 0;        // in included files
};

}  // namespace presa::robot
