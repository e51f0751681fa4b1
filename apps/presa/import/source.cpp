#include "apps/presa/import/source.h"

#include <algorithm>

#include "apps/common/atomic_file.h"
#include "apps/presa/import/codes.h"
#include "apps/presa/import/preparation.h"
#include "framework/geometry/obj_text.h"
#include "framework/geometry/tri_mesh.h"
#include "framework/input/folders.h"
#include "framework/scene/xml/source_scan.h"
#include "framework/scene/xml/value_rule.h"

namespace presa::robot {
namespace {

namespace fs = std::filesystem;

constexpr int kRoundTripDigits = 9;  // every number of single precision as it is

/// The element that is `left` elements after `element`, in the order of their start tags; counts `left` down.
std::optional<xml::Element> elementAfter(const xml::Element& element, std::size_t& left) {
  if (left == 0) return element;
  --left;
  for (const xml::Element& child : element.children())
    if (auto found = elementAfter(child, left)) return found;
  return std::nullopt;
}

std::optional<xml::Element> elementNamed(const xml::Element& element, const std::string& name) {
  const bool is_link = element.name() == "link" || element.name() == "body";
  if (is_link && element.attribute("name") == name) return element;
  for (const xml::Element& child : element.children())
    if (auto found = elementNamed(child, name)) return found;
  return std::nullopt;
}

}  // namespace

void LeftOuts::add(const std::string& what, const SourceLocation& where) {
  const auto known = std::ranges::find(all_, what, &LeftOut::what);
  if (known != all_.end())
    ++known->count;
  else
    all_.push_back({what, where, 1});
}

SourceLocation whereOf(const Source& source, int line) {
  const xml::SourceScan scan = xml::scanSource(source.document->text());
  // the last element that begins on this line or before
  const auto after = std::ranges::find_if(scan.tags, [&](const xml::ScannedTag& tag) { return tag.at.line > line; });
  std::size_t before = static_cast<std::size_t>(after - scan.tags.begin());
  before = before == 0 ? 0 : before - 1;
  const auto element = elementAfter(source.document->root(), before);
  return element ? element->where() : source.document->root().where();
}

SourceLocation whereIsLink(const Source& source, const std::string& name) {
  const auto element = elementNamed(source.document->root(), name);
  return element ? element->where() : source.document->root().where();
}

std::optional<Source> prepare(const std::string& file, const fs::path& scratch, const SourceOptions& options,
                              Diagnostics& diagnostics) {
  return Preparation(file, scratch, options, diagnostics).run();
}

Preparation::Preparation(const std::string& file, fs::path scratch, const SourceOptions& options,
                         Diagnostics& diagnostics)
    : file_(file), scratch_(std::move(scratch)), options_(options), diagnostics_(diagnostics) {}

std::optional<Source> Preparation::run() {
  source_.document = xml::Document::load(file_, diagnostics_);
  if (source_.document == nullptr) return std::nullopt;
  const xml::Element root = source_.document->root();
  if (root.name() == "robot")
    urdf(root);
  else if (root.name() == "mujoco")
    mjcf(root);
  else
    fail(kNeither, root.where(), "<" + root.name() + "> is the root of neither URDF nor MJCF",
         "URDF begins with <robot>, MJCF with <mujoco>");
  refuseOddNumbers(root);
  if (diagnostics_.hasErrors()) return std::nullopt;
  if (source_.name.empty()) source_.name = fs::path(file_).stem().string();
  source_.file = scratch_ / "model.xml";
  writeFileAtomically(source_.file.string(), source_.document->text());
  return std::move(source_);
}

bool Preparation::fail(int code, const SourceLocation& where, const std::string& what, const std::string& help) {
  diagnostics_.error(code, where, what, help);
  return false;
}

// MuJoCo reads "nan" as a number.
void Preparation::refuseOddNumbers(const xml::Element& element) {
  static const Names kTexts{"name", "class", "childclass", "file",  "filename",
                            "link", "mesh",  "material",   "model", "joint"};
  for (const std::string& name : element.attributeNames()) {
    if (kTexts.contains(name)) continue;
    for (const std::string& word : xml::splitWords(element.attribute(name))) {
      double number = 0;
      if (xml::readNumber(word, number) == xml::NumberKind::kNotFinite)
        fail(kUnreadable, element.where(name), quote(name) + " is not finite, found " + quote(element.attribute(name)));
    }
  }
  for (const xml::Element& child : element.children()) refuseOddNumbers(child);
}

void Preparation::leaveOut(xml::Element element) {
  source_.left_out.add("<" + element.name() + ">", element.where());
  element.remove();
}

void Preparation::leaveOut(xml::Element of, const std::string& attribute, const std::string& what) {
  if (!of.hasAttribute(attribute)) return;
  source_.left_out.add(what, of.where(attribute));
  of.removeAttribute(attribute);
}

void Preparation::keepOnly(const xml::Element& of, const Names& names) {
  for (const xml::Element& child : of.children())
    if (!names.contains(child.name())) leaveOut(child);
}

// Limits count where they are given, as later versions of MJCF say.
xml::Element Preparation::compiler(xml::Element root) {
  std::vector<xml::Element> all = root.children("compiler");
  if (all.empty()) all.push_back(root.addChild("compiler", root.where()));
  for (xml::Element& settings : all) {
    if (settings.hasAttribute("assetdir")) mesh_folder_ = settings.attribute("assetdir");
    if (settings.hasAttribute("meshdir")) mesh_folder_ = settings.attribute("meshdir");
    strip_path_ = settings.boolean("strippath", strip_path_);
    for (const char* used : {"meshdir", "texturedir", "assetdir"}) settings.removeAttribute(used);
    settings.setAttribute("strippath", "false");
    settings.setAttribute("fusestatic", "true");
    if (!settings.hasAttribute("autolimits")) settings.setAttribute("autolimits", "true");
  }
  return all.back();
}

std::string Preparation::meshFile(const std::string& path, const SourceLocation& where, const Vec3& scale) {
  const auto [known, is_new] = meshes_.try_emplace({path, {scale.x(), scale.y(), scale.z()}});
  std::string& made = known->second;
  if (!is_new) return made;
  if (!input::checkNamed(where, path, diagnostics_)) return {};
  std::error_code error;
  if (!fs::exists(path, error)) {
    fail(kNoFile, where, "there is no file " + quote(path));
    return {};
  }
  const ImportOptions options{.must_be_closed = false, .display_only = true, .scale = scale};
  const TriMesh mesh = importMesh(path, options, where, diagnostics_);
  if (mesh.triangles.empty()) return {};
  const std::string name = fs::path(path).stem().string().substr(0, 60) + "_" + std::to_string(meshes_.size()) + ".obj";
  made = (scratch_ / name).string();
  writeFileAtomically(made, objText(mesh, kRoundTripDigits));
  return made;
}

}  // namespace presa::robot
