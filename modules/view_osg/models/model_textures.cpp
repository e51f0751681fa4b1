#include "modules/view_osg/models/model_textures.h"

#include <map>
#include <mutex>
#include <osg/observer_ptr>
#include <string>
#include <tuple>

#include "modules/view_osg/models/model_images.h"

namespace presa::view {
namespace {

/// What others hold, by key: it is made again when all of them have let go.
template <class Key, class Thing>
class Shared {
 public:
  template <class Make>
  osg::ref_ptr<Thing> get(const Key& key, const Make& make) {
    std::erase_if(all_, [](const auto& one) { return !one.second.valid(); });
    osg::ref_ptr<Thing> found;
    if (!all_[key].lock(found)) all_[key] = found = make();
    return found;
  }

 private:
  std::map<Key, osg::observer_ptr<Thing>> all_;
};

/// A file that was exported again meanwhile has pictures of other sizes, or none that matter.
using TextureKey = std::tuple<std::string, int, std::string, int, int, std::size_t>;

TextureKey pictureOf(const Model& model, int index) {
  const ModelTexture& texture = model.textures[static_cast<std::size_t>(index)];
  return {model.file, index, texture.file, texture.width, texture.height, texture.bytes.size()};
}

class Textures {
 public:
  osg::ref_ptr<osg::Image> image(const Model& model, int index) {
    const std::lock_guard lock(guard_);
    return decoded(model, index);
  }

  osg::ref_ptr<osg::Texture2D> texture(const Model& model, int index, TextureUse use) {
    const std::lock_guard lock(guard_);
    return textures_.get({pictureOf(model, index), use}, [&] { return make(model, index, use); });
  }

 private:
  osg::ref_ptr<osg::Image> decoded(const Model& model, int index) {
    return images_.get(pictureOf(model, index),
                       [&] { return decodeTexture(model, model.textures[static_cast<std::size_t>(index)]); });
  }

  osg::ref_ptr<osg::Texture2D> make(const Model& model, int index, TextureUse use) {
    osg::ref_ptr<osg::Image> image = decoded(model, index);
    if (use == TextureUse::kNormal && isGrey(*image)) image = normalsOf(*image);
    const bool quick = use == TextureUse::kQuickColor;
    osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(image);
    texture->setResizeNonPowerOfTwoHint(false);
    texture->setInternalFormat(use == TextureUse::kColor ? GL_SRGB8 : GL_RGB8);
    texture->setFilter(osg::Texture::MIN_FILTER,
                       quick ? osg::Texture::LINEAR_MIPMAP_NEAREST : osg::Texture::LINEAR_MIPMAP_LINEAR);
    texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::LINEAR);
    for (const auto axis : {osg::Texture::WRAP_S, osg::Texture::WRAP_T}) texture->setWrap(axis, osg::Texture::REPEAT);
    return texture;
  }

  std::mutex guard_;
  Shared<TextureKey, osg::Image> images_;
  Shared<std::pair<TextureKey, TextureUse>, osg::Texture2D> textures_;
};

Textures& textures() {
  static Textures all;
  return all;
}

}  // namespace

osg::ref_ptr<osg::Texture2D> textureOf(const Model& model, int index, TextureUse use) {
  return textures().texture(model, index, use);
}

osg::ref_ptr<osg::Image> imageOf(const Model& model, int index) { return textures().image(model, index); }

}  // namespace presa::view
