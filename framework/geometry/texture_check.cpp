#include "framework/geometry/texture_check.h"

#include <algorithm>
#include <filesystem>

#include "framework/geometry/image_size.h"
#include "framework/input/folders.h"
#include "framework/input/input.h"

namespace presa {
namespace {

namespace fs = std::filesystem;

enum TextureCode { kMissing = 260, kUnknownFormat = 261, kTooLarge = 262 };

constexpr std::size_t kHeadBytes = 4U << 20U;  // what comes before the size: a thumbnail, a colour profile

/// "my%20stone.jpg" as "my stone.jpg": glTF names files by URI.
std::string decoded(const std::string& uri) {
  const auto digit = [](char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0 ? c - '0' : (c | 32) - 'a' + 10;
  };
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const bool escaped = uri[i] == '%' && i + 2 < uri.size() && std::isxdigit(static_cast<unsigned char>(uri[i + 1])) &&
                         std::isxdigit(static_cast<unsigned char>(uri[i + 2]));
    text += escaped ? static_cast<char>(16 * digit(uri[i + 1]) + digit(uri[i + 2])) : uri[i];
    if (escaped) i += 2;
  }
  return text;
}

/// The path of a texture; the name may be a URI, or have the separators of another system.
std::string pathOf(const std::string& name, const fs::path& folder) {
  std::string slashed = name;
  std::ranges::replace(slashed, '\\', '/');
  std::error_code ignored;
  for (const std::string& one : {name, slashed, decoded(name)})
    if (fs::exists(folder / one, ignored)) return (folder / one).lexically_normal().string();
  return (folder / slashed).lexically_normal().string();
}

std::string pixels(std::uint64_t width, std::uint64_t height) {
  return std::to_string(width) + " by " + std::to_string(height) + " pixels";
}

class TextureCheck {
 public:
  TextureCheck(Model& model, const SourceLocation& where, Diagnostics& diagnostics)
      : model_(model), where_(where), diagnostics_(diagnostics) {}

  void run() {
    std::uint64_t texels = 0;
    bool good = true;
    for (ModelTexture& texture : model_.textures) {
      good = check(texture) && good;
      texels += std::uint64_t(texture.width) * std::uint64_t(texture.height);
    }
    if (!good || texels <= kMaxTexels) return;
    diagnostics_.error(kTooLarge, where_,
                       "model " + model_.file + ": its " + std::to_string(model_.textures.size()) + " textures have " +
                           std::to_string(texels >> 20U) + " million pixels together, up to " +
                           std::to_string(kMaxTexels >> 20U) + " million are drawn",
                       "make them smaller, or fewer");
  }

 private:
  bool fail(const ModelTexture& texture, int code, const std::string& what, const std::string& help) {
    diagnostics_.error(code, where_, "model " + model_.file + ": its texture " + quote(texture.name) + " " + what,
                       help);
    return false;
  }

  std::optional<std::string> headOf(ModelTexture& texture) {
    const std::string folder = fs::path(model_.file).parent_path().string();
    texture.file = pathOf(texture.name, folder);
    if (!input::mayName(folder, texture.file)) {
      diagnostics_.error(input::kOutside, where_,
                         "model " + model_.file + ": its texture " + input::outside(folder, texture.file),
                         input::kOutsideHelp);
      return std::nullopt;
    }
    std::error_code ignored;
    if (!fs::exists(texture.file, ignored)) {
      fail(texture, kMissing, "is missing: there is no file " + texture.file,
           "copy it to that place, or export the model with its textures inside (glb)");
      return std::nullopt;
    }
    input::Refusal refusal;
    const std::optional<input::File> file = input::open(texture.file, kMaxTextureBytes, refusal);
    std::string head(kHeadBytes, '\0');
    std::size_t size = 0;
    while (file && size < head.size()) {
      const std::ptrdiff_t got = input::readSome(*file, head.data() + size, head.size() - size);
      if (got <= 0) break;
      size += static_cast<std::size_t>(got);
    }
    if (!file) {
      fail(texture, refusal.code(kMissing), refusal.what, refusal.help);
      return std::nullopt;
    }
    head.resize(size);
    return head;
  }

  bool check(ModelTexture& texture) {
    const bool embedded = !texture.bytes.empty();
    const std::optional<std::string> head = embedded ? std::nullopt : headOf(texture);
    if (!embedded && !head) return false;
    const std::optional<ImageSize> size = imageSize(embedded ? texture.bytes : *head);
    if (!size)
      return fail(texture, kUnknownFormat, "is neither a PNG nor a JPEG picture, or is damaged", "use PNG or JPEG");
    if (std::max(size->width, size->height) > std::uint32_t{kMaxTextureSide})
      return fail(texture, kTooLarge,
                  "has " + pixels(size->width, size->height) + ", up to " + pixels(kMaxTextureSide, kMaxTextureSide) +
                      " are drawn",
                  "make it smaller");
    texture.width = static_cast<int>(size->width);
    texture.height = static_cast<int>(size->height);
    return true;
  }

  Model& model_;
  const SourceLocation& where_;
  Diagnostics& diagnostics_;
};

}  // namespace

void checkTextures(Model& model, const SourceLocation& where, Diagnostics& diagnostics) {
  TextureCheck(model, where, diagnostics).run();
}

}  // namespace presa
