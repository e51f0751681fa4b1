#pragma once
#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>
#include <optional>
#include <string>

#include "framework/geometry/mesh_import_plugin/mesh_reader.h"

namespace presa {

/// Assimp's way to files: each goes through framework/input, also those that a mesh names (mtllib, buffers), which must lie where a
/// mesh may name them. All together have at most kMaxMeshBytes.
class InputSystem final : public Assimp::IOSystem {
 public:
  explicit InputSystem(const std::string& mesh);
  bool Exists(const char* file) const override;
  char getOsSeparator() const override { return '/'; }
  /// Null when it does not exist, and when it is refused; then problem() says why. Nothing is opened for writing.
  Assimp::IOStream* Open(const char* file, const char* mode) override;
  void Close(Assimp::IOStream* stream) override;
  /// The first file that was there and refused.
  const std::optional<RawMesh::Problem>& problem() const { return problem_; }

 private:
  void refuse(int code, const std::string& what, const std::string& help);

  std::string mesh_, folder_;
  std::uint64_t left_;
  std::optional<RawMesh::Problem> problem_;
};

}  // namespace presa
