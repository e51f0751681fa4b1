#include "apps/presa/gallery/entries.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <tuple>

#include "apps/presa/gallery/groups.h"
#include "framework/input/folders.h"
#include "framework/scene/xml/xml.h"

namespace presa::gallery {
namespace {

namespace fs = std::filesystem;

enum Code { kUnknownScene = 140, kNoScenes = 141 };

Entry read(const fs::path& scene, const fs::path& config, Diagnostics& diagnostics) {
  Entry entry{.name = scene.stem().string(), .group = {}, .sentence = {}, .file = scene.string(), .picture = {}};
  if (const auto document = xml::Document::load(entry.file, diagnostics)) {
    entry.group = document->root().attribute("group");
    entry.sentence = document->root().attribute("description");
  }
  const fs::path picture = config / "pictures/scenes" / (entry.name + ".png");
  std::error_code none;
  if (fs::is_regular_file(picture, none)) entry.picture = picture.string();
  return entry;
}

/// Place of a group; those that are not listed come last, by name.
std::tuple<std::size_t, std::string> placeOf(const std::string& group) {
  const auto found = std::ranges::find(groups(), group, &Group::name);
  return {static_cast<std::size_t>(found - groups().begin()), group};
}

}  // namespace

std::vector<Entry> entries(Diagnostics& diagnostics) {
  const fs::path config = input::ownFolder("config");
  std::vector<Entry> all;
  std::error_code none;
  if (!config.empty()) {
    for (const auto& file : fs::directory_iterator(config / "scenes", none))
      if (file.path().extension() == ".xml") all.push_back(read(file.path(), config, diagnostics));
  }
  if (all.empty())
    diagnostics.error(kNoScenes, {"presa gallery", 0, 0},
                      "there is no folder config/scenes with scenes near this program",
                      "run the presa of a source tree (build/bin/presa) or of an installation (./dev install)");
  std::ranges::sort(all, [](const Entry& a, const Entry& b) {
    return std::tuple(placeOf(a.group), a.name) < std::tuple(placeOf(b.group), b.name);
  });
  return all;
}

std::optional<std::size_t> find(const std::vector<Entry>& entries, const std::string& name, Diagnostics& diagnostics) {
  const auto found = std::ranges::find(entries, name, &Entry::name);
  if (found != entries.end()) return static_cast<std::size_t>(found - entries.begin());
  std::vector<std::string> names;
  std::ranges::transform(entries, std::back_inserter(names), &Entry::name);
  diagnostics.error(kUnknownScene, {"presa gallery", 0, 0},
                    "there is no scene " + quote(name) + " in the gallery" + didYouMean(name, names),
                    "presa gallery lists them; presa run FILE runs a scene of your own");
  return std::nullopt;
}

}  // namespace presa::gallery
