#include "framework/geometry/mesh_import_plugin/input_system.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <string_view>

#include "framework/geometry/mesh_import_abi.h"
#include "framework/input/folders.h"
#include "framework/input/input.h"

namespace presa {
namespace {

enum Code { kUnreadable = 303 };

/// A read-only stream over the bytes of a file in memory.
class Bytes final : public Assimp::IOStream {
 public:
  explicit Bytes(std::string text) : text_(std::move(text)) {}

  std::size_t Read(void* to, std::size_t size, std::size_t count) override {
    if (size == 0) return 0;
    const std::size_t whole = std::min(count, (text_.size() - at_) / size);
    std::memcpy(to, text_.data() + at_, whole * size);
    at_ += whole * size;
    return whole;
  }
  std::size_t Write(const void* /*from*/, std::size_t /*size*/, std::size_t /*count*/) override { return 0; }
  aiReturn Seek(std::size_t offset, aiOrigin origin) override {
    const std::size_t base = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? at_ : text_.size();
    const std::size_t to = base + offset;  // assimp passes negative offsets as wrapped unsigned numbers
    if (to > text_.size()) return aiReturn_FAILURE;
    at_ = to;
    return aiReturn_SUCCESS;
  }
  std::size_t Tell() const override { return at_; }
  std::size_t FileSize() const override { return text_.size(); }
  void Flush() override {}

 private:
  std::string text_;
  std::size_t at_ = 0;
};

bool exists(const char* file) {
  std::error_code ignored;
  return std::filesystem::exists(file, ignored);
}

}  // namespace

InputSystem::InputSystem(const std::string& mesh)
    : mesh_(mesh), folder_(std::filesystem::path(mesh).parent_path().string()), left_(kMaxMeshBytes) {}

void InputSystem::refuse(int code, const std::string& what, const std::string& help) {
  if (!problem_) problem_ = RawMesh::Problem{code, what, help};
}

bool InputSystem::Exists(const char* file) const { return exists(file); }

Assimp::IOStream* InputSystem::Open(const char* file, const char* mode) {
  if (std::string_view(mode).find_first_of("wa+") != std::string_view::npos) return nullptr;
  if (!exists(file)) {
    if (missing_library_.empty() && std::filesystem::path(file).extension() == ".mtl") missing_library_ = file;
    return nullptr;
  }
  if (file != mesh_ && !input::mayName(folder_, file)) {
    refuse(input::kOutside, input::outside(folder_, file), input::kOutsideHelp);
    return nullptr;
  }
  input::Refusal refusal;
  auto text = input::read(file, left_, refusal);
  if (!text) {
    refuse(refusal.code(kUnreadable), (file != mesh_ ? quote(file) + ", which it names, " : "it ") + refusal.what,
           refusal.help);
    return nullptr;
  }
  if (std::filesystem::path(file).extension() == ".mtl") missing_library_.clear();  // found under another name
  // assimp may open a file several times; Close returns its bytes to the budget
  left_ -= text->size();
  return new Bytes(std::move(*text));
}

void InputSystem::Close(Assimp::IOStream* stream) {
  if (stream != nullptr) left_ += stream->FileSize();
  delete stream;
}

}  // namespace presa
