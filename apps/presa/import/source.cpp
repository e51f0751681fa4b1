#include "apps/presa/import/source.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <sstream>

#include "apps/common/atomic_file.h"
#include "apps/presa/import/codes.h"
#include "framework/geometry/obj_text.h"
#include "framework/geometry/tri_mesh.h"
#include "framework/input/folders.h"

namespace presa::robot {
namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

constexpr int kDigits = 9;  // every number of single precision as it is
constexpr int kMaxIncludes = 100;

/// The names of a URDF's packages: package://NAME/rest.
constexpr std::string_view kPackage = "package://", kFile = "file://", kModel = "model://";

class Preparation {
 public:
  Preparation(const std::string& file, fs::path scratch, const SourceOptions& options, Diagnostics& diagnostics)
      : file_(file), scratch_(std::move(scratch)), options_(options), diagnostics_(diagnostics) {}

  std::optional<Source> run() {
    source_.document = xml::Document::load(file_, diagnostics_);
    if (source_.document == nullptr) return std::nullopt;
    const xml::Element root = source_.document->root();
    if (root.name() == "robot")
      urdf(root);
    else if (root.name() == "mujoco")
      mjcf(root);
    else
      diagnostics_.error(kNeither, root.where(), "<" + root.name() + "> is the root of neither URDF nor MJCF",
                         "URDF begins with <robot>, MJCF with <mujoco>; xacro files are turned into URDF by xacro");
    if (diagnostics_.hasErrors()) return std::nullopt;
    if (source_.name.empty()) source_.name = fs::path(file_).stem().string();
    source_.file = scratch_ / "model.xml";
    writeFileAtomically(source_.file.string(), source_.document->text());
    return std::move(source_);
  }

 private:
  /// Takes out the children of these names, or all but these.
  void drop(const xml::Element& of, const Names& names, bool all_but = false) {
    for (xml::Element& child : of.children()) {
      if (names.contains(child.name()) == all_but) continue;
      source_.left_out.add("<" + child.name() + ">", child.where());
      child.remove();
    }
  }
  void dropAttribute(xml::Element of, const std::string& attribute, const std::string& what) {
    if (!of.hasAttribute(attribute)) return;
    source_.left_out.add(what, of.where(attribute));
    of.removeAttribute(attribute);
  }

  void urdf(xml::Element root);
  void urdfLink(const xml::Element& link);
  void urdfJoint(const xml::Element& joint);
  void mjcf(xml::Element root);
  void include(const xml::Element& in, int depth);
  void mjcfAssets(const xml::Element& root);
  void mjcfBody(xml::Element body);
  void defaults(const xml::Element& of);
  xml::Element compiler(xml::Element root);
  std::string packageFile(const std::string& name, const SourceLocation& where);
  std::string meshFile(const std::string& path, const SourceLocation& where, const Vec3& scale = Vec3::Ones());

  const std::string& file_;
  fs::path scratch_;
  const SourceOptions& options_;
  Diagnostics& diagnostics_;
  Source source_;
  /// File and scale -> its OBJ in the scratch folder.
  std::map<std::pair<std::string, std::array<double, 3>>, std::string> meshes_;
  std::string mesh_folder_;
  bool strip_path_ = false;
};

// ---- URDF ----------------------------------------------------------------------------------------------------------

/// The link that is no joint's child.
std::optional<xml::Element> rootOf(const xml::Element& robot) {
  Names children;
  for (const xml::Element& joint : robot.children("joint"))
    for (const xml::Element& child : joint.children("child")) children.insert(child.attribute("link"));
  for (const xml::Element& link : robot.children("link"))
    if (!children.contains(link.attribute("name"))) return link;
  return std::nullopt;
}

/// A joint that leaves the root free, between it and the world.
void freeBase(xml::Element robot, const xml::Element& root) {
  const SourceLocation where = root.where();
  robot.addChild("link", where).setAttribute("name", "presa_world");
  xml::Element joint = robot.addChild("joint", where);
  joint.setAttribute("name", "presa_world");
  joint.setAttribute("type", "floating");
  joint.addChild("parent", where).setAttribute("link", "presa_world");
  joint.addChild("child", where).setAttribute("link", root.attribute("name"));
}

void Preparation::urdf(xml::Element root) {
  source_.name = root.attribute("name");
  drop(root, {"link", "joint", "material", "mujoco"}, true);
  for (const xml::Element& material : root.children("material")) drop(material, {"texture"});
  for (const xml::Element& link : root.children("link")) urdfLink(link);
  for (const xml::Element& joint : root.children("joint")) urdfJoint(joint);
  if (const auto base = rootOf(root)) {
    if (options_.free_base)
      freeBase(root, *base);
    else
      source_.root = base->attribute("name");
  }
  const std::vector<xml::Element> given = root.children("mujoco");
  xml::Element mujoco = given.empty() ? root.addChild("mujoco", root.where()) : given.front();
  xml::Element settings = compiler(mujoco);
  settings.setAttribute("discardvisual", "false");
}

void Preparation::urdfLink(const xml::Element& link) {
  drop(link, {"visual", "collision", "inertial"}, true);
  for (const xml::Element& drawn : link.children("visual")) {
    for (const xml::Element& material : drawn.children("material")) drop(material, {"texture"});
  }
  for (const char* use : {"visual", "collision"}) {
    for (const xml::Element& shape : link.children(use)) {
      for (const xml::Element& geometry : shape.children("geometry")) {
        for (xml::Element& mesh : geometry.children("mesh")) {
          const SourceLocation where = mesh.where("filename");
          // MuJoCo would take a mesh of two scales for one
          const std::vector<double> factors = mesh.numbers("scale");
          const Vec3 scale = factors.size() == 3 ? Vec3(factors[0], factors[1], factors[2]) : Vec3(Vec3::Ones());
          mesh.removeAttribute("scale");
          mesh.setAttribute("filename", meshFile(packageFile(mesh.attribute("filename"), where), where, scale));
        }
      }
    }
  }
}

void Preparation::urdfJoint(const xml::Element& joint) {
  drop(joint, {"origin", "parent", "child", "axis", "limit", "dynamics"}, true);
  for (const xml::Element& limit : joint.children("limit")) {
    if (limit.number("effort", 0) != 0 || limit.number("velocity", 0) != 0)
      source_.left_out.add("effort and velocity of <limit>", limit.where());
  }
}

/// A file of a package lies in the package's folder, which is above the URDF.
std::string Preparation::packageFile(const std::string& name, const SourceLocation& where) {
  for (const std::string_view scheme : {kPackage, kModel}) {
    if (!name.starts_with(scheme)) continue;
    const fs::path rest = name.substr(scheme.size());
    for (fs::path folder = fs::absolute(where.file).parent_path(); folder != folder.root_path();
         folder = folder.parent_path()) {
      if (folder.filename() != *rest.begin()) continue;
      // the folder of a package is known by this file: what lies in it belongs together
      if (fs::exists(folder / "package.xml")) input::allowFolder(folder.string());
      return (folder.parent_path() / rest).string();
    }
    diagnostics_.error(kNoFile, where,
                       "there is no folder '" + rest.begin()->string() + "' above this file, found " + quote(name),
                       "a package is a folder of its name that contains the URDF");
    return {};
  }
  const std::string path = name.starts_with(kFile) ? name.substr(kFile.size()) : name;
  return (fs::path(where.file).parent_path() / path).string();
}

// ---- MJCF ----------------------------------------------------------------------------------------------------------

void Preparation::mjcf(xml::Element root) {
  source_.name = root.attribute("model");
  include(root, 0);
  if (diagnostics_.hasErrors()) return;
  drop(root, {"compiler", "option", "size", "default", "asset", "worldbody"}, true);
  compiler(root);
  for (const xml::Element& of : root.children("default")) defaults(of);
  mjcfAssets(root);
  for (const xml::Element& world : root.children("worldbody")) mjcfBody(world);
}

/// Files are included once each, by their names from the folder of the first file.
void Preparation::include(const xml::Element& in, int depth) {
  for (xml::Element& child : in.children()) {
    if (child.name() != "include") {
      include(child, depth);
      continue;
    }
    const SourceLocation where = child.where("file");
    const std::string file = (fs::path(file_).parent_path() / child.attribute("file")).string();
    if (depth >= kMaxIncludes) {
      diagnostics_.error(kNoFile, where, "files include each other more than " + std::to_string(kMaxIncludes) + " deep",
                         "");
      return;
    }
    if (!input::checkNamed(where, file, diagnostics_)) continue;
    const auto included = xml::Document::load(file, diagnostics_);
    if (included == nullptr) continue;
    include(included->root(), depth + 1);
    for (const xml::Element& part : included->root().children()) child.insertCopy(part);
    child.remove();
  }
}

void Preparation::mjcfAssets(const xml::Element& root) {
  for (const xml::Element& assets : root.children("asset")) {
    drop(assets, {"mesh", "material"}, true);
    for (const xml::Element& material : assets.children("material")) dropAttribute(material, "texture", "<texture>");
    for (xml::Element& mesh : assets.children("mesh")) {
      const std::string file = mesh.attribute("file");
      if (file.empty()) continue;  // its vertices stand in the element
      if (!mesh.hasAttribute("name")) mesh.setAttribute("name", fs::path(file).stem().string());
      const fs::path named = strip_path_ ? fs::path(file).filename() : fs::path(file);
      const SourceLocation where = mesh.where("file");
      mesh.setAttribute("file", meshFile((fs::path(file_).parent_path() / mesh_folder_ / named).string(), where));
      mesh.removeAttribute("content_type");
    }
  }
}

void Preparation::mjcfBody(xml::Element body) {
  // a later version of MJCF has it
  if (body.hasAttribute("gravcomp")) {
    if (!body.hasAttribute("name")) body.setAttribute("name", "carried_" + std::to_string(source_.carried.size() + 1));
    source_.carried[body.attribute("name")] = body.number("gravcomp", 0);
    body.removeAttribute("gravcomp");
  }
  drop(body, {"site", "camera", "light", "plugin"});
  for (xml::Element& geom : body.children("geom")) {
    if (geom.attribute("type") != "hfield") continue;
    source_.left_out.add("<geom type=\"hfield\">", geom.where());
    geom.remove();
  }
  for (const xml::Element& child : body.children("body")) mjcfBody(child);
}

void Preparation::defaults(const xml::Element& of) {
  for (const xml::Element& material : of.children("material")) dropAttribute(material, "texture", "<texture>");
  for (const xml::Element& inner : of.children("default")) defaults(inner);
}

// ---- both ----------------------------------------------------------------------------------------------------------

/// Its settings of folders are used up here; limits count where they are given, as later versions of MJCF say.
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

/// The mesh as an OBJ file, so that only Presa's own reader opens the file.
std::string Preparation::meshFile(const std::string& path, const SourceLocation& where, const Vec3& scale) {
  if (path.empty()) return {};
  const auto [known, is_new] = meshes_.try_emplace({path, {scale.x(), scale.y(), scale.z()}});
  std::string& made = known->second;
  if (!is_new) return made;
  std::error_code error;
  if (!fs::exists(path, error)) {
    diagnostics_.error(kNoFile, where, "there is no file " + quote(path), "names are relative to this file");
    return {};
  }
  if (!input::checkNamed(where, path, diagnostics_)) return {};
  const TriMesh mesh =
      importMesh(path, {.must_be_closed = false, .display_only = true, .scale = scale}, where, diagnostics_);
  if (mesh.triangles.empty()) return {};
  const std::string name = fs::path(path).stem().string() + "_" + std::to_string(meshes_.size()) + ".obj";
  made = (scratch_ / name).string();
  writeFileAtomically(made, objText(mesh, kDigits));
  return made;
}

bool beginsElement(const std::string& line) {
  const std::size_t at = line.find_first_not_of(' ');
  return at != std::string::npos && line[at] == '<' && at + 1 < line.size() &&
         (std::isalpha(static_cast<unsigned char>(line[at + 1])) != 0 || line[at + 1] == '_');
}

/// The element that is `left` elements after `element`, in the order of their start tags; counts `left` down.
std::optional<xml::Element> elementAfter(const xml::Element& element, int& left) {
  if (left == 0) return element;
  --left;
  for (const xml::Element& child : element.children())
    if (auto found = elementAfter(child, left)) return found;
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

std::optional<Source> prepare(const std::string& file, const fs::path& scratch, const SourceOptions& options,
                              Diagnostics& diagnostics) {
  return Preparation(file, scratch, options, diagnostics).run();
}

SourceLocation whereOf(const Source& source, int line) {
  std::istringstream text(source.document->text());
  int before = -1;  // elements before the one on this line
  std::string read;
  for (int i = 0; i < line && std::getline(text, read); ++i) before += beginsElement(read) ? 1 : 0;
  const auto element = before < 0 ? std::nullopt : elementAfter(source.document->root(), before);
  return element ? element->where() : source.document->root().where();
}

}  // namespace presa::robot
