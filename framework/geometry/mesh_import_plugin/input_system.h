#pragma once
#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>
#include <optional>
#include <string>

#include "framework/geometry/mesh_import_plugin/mesh_reader.h"

namespace presa {

/// File access for assimp. Every file goes through framework/input, including files that the mesh names (mtllib,
/// buffers), which must lie in a folder where input::mayName allows them. All open files together have at most
/// kMaxMeshBytes.
class InputSystem final : public Assimp::IOSystem {
 public:
  explicit InputSystem(const std::string& mesh);
  bool Exists(const char* file) const override;
  char getOsSeparator() const override { return '/'; }
  /// Null when the file does not exist or is refused; problem() then gives the reason. Read only.
  Assimp::IOStream* Open(const char* file, const char* mode) override;
  void Close(Assimp::IOStream* stream) override;
  /// The first file that existed and was refused.
  const std::optional<RawMesh::Problem>& problem() const { return problem_; }
  /// The first file of materials (MTL) that was asked for and is not there; "": none.
  const std::string& missingLibrary() const { return missing_library_; }

 private:
  void refuse(int code, const std::string& what, const std::string& help);

  std::string mesh_, folder_, missing_library_;
  std::uint64_t left_;
  std::optional<RawMesh::Problem> problem_;
};

}  // namespace presa
