#include <algorithm>

#include "apps/presa/import/codes.h"
#include "apps/presa/import/preparation.h"
#include "framework/input/folders.h"

namespace presa::robot {
namespace {

namespace fs = std::filesystem;

/// The link that is no joint's child.
std::optional<xml::Element> rootOf(const xml::Element& robot) {
  std::set<std::string> children;
  for (const xml::Element& joint : robot.children("joint"))
    for (const xml::Element& child : joint.children("child")) children.insert(child.attribute("link"));
  for (const xml::Element& link : robot.children("link"))
    if (!children.contains(link.attribute("name"))) return link;
  return std::nullopt;
}

/// Elements of xacro, which makes URDF from a text with macros.
bool isXacro(const xml::Element& element) { return element.name().starts_with("xacro:"); }

}  // namespace

void Preparation::urdf(xml::Element root) {
  for (const xml::Element& child : root.children()) {
    if (!isXacro(child)) continue;
    fail(kNeither, child.where(), "<" + child.name() + "> is of xacro, which MuJoCo does not read",
         "turn the file into URDF: xacro FILE.xacro > FILE.urdf");
    return;
  }
  source_.name = root.attribute("name");
  keepOnly(root, {"link", "joint", "material", "mujoco"});
  const std::vector<xml::Element> given = root.children("mujoco");
  xml::Element mujoco = given.empty() ? root.addChild("mujoco", root.where()) : given.front();
  keepOnly(mujoco, {"compiler"});
  xml::Element settings = compiler(mujoco);
  settings.setAttribute("discardvisual", "false");
  for (const xml::Element& material : root.children("material")) keepOnly(material, {"color"});
  for (const xml::Element& link : root.children("link")) urdfLink(link);
  for (const xml::Element& joint : root.children("joint")) urdfJoint(joint);
  urdfBase(root);
}

void Preparation::urdfLink(const xml::Element& link) {
  keepOnly(link, {"visual", "collision", "inertial"});
  for (const xml::Element& drawn : link.children("visual"))
    for (const xml::Element& material : drawn.children("material")) keepOnly(material, {"color"});
  for (const char* use : {"visual", "collision"})
    for (const xml::Element& shape : link.children(use))
      for (const xml::Element& geometry : shape.children("geometry"))
        for (const xml::Element& mesh : geometry.children("mesh")) urdfMesh(mesh);
}

// The scale goes into the file that is written: MuJoCo would take a mesh of two scales for one.
void Preparation::urdfMesh(xml::Element mesh) {
  Vec3 scale = Vec3::Ones();
  if (mesh.hasAttribute("scale")) {
    const std::vector<double> factors = mesh.numbers("scale");
    if (factors.size() == 3) scale = Vec3(factors[0], factors[1], factors[2]);
    if (factors.size() != 3 || (scale.array() == 0).any()) {
      fail(kUnreadable, mesh.where("scale"),
           "the scale of a mesh is three numbers, none of them zero, found " + quote(mesh.attribute("scale")),
           "0.001 0.001 0.001 turns millimetres into metres");
      return;
    }
    mesh.removeAttribute("scale");
  }
  const SourceLocation where = mesh.where("filename");
  const std::string path = urdfFile(mesh.attribute("filename"), where);
  if (!path.empty()) mesh.setAttribute("filename", meshFile(path, where, scale));
}

void Preparation::urdfJoint(const xml::Element& joint) {
  static const std::vector<std::string> kTypes{"revolute", "continuous", "prismatic", "fixed", "floating", "planar"};
  const std::string kind = joint.attribute("type");
  if (std::ranges::find(kTypes, kind) == kTypes.end()) {
    fail(kUnreadable, joint.where("type"), "URDF has no joint of type " + quote(kind) + didYouMean(kind, kTypes),
         "revolute, continuous, prismatic, fixed, floating, planar");
  }
  keepOnly(joint, {"origin", "parent", "child", "axis", "limit", "dynamics"});
  for (const xml::Element& limit : joint.children("limit")) {
    if (limit.number("effort", 0) != 0 || limit.number("velocity", 0) != 0)
      source_.left_out.add("effort and velocity of <limit>", limit.where());
    if ((kind == "revolute" || kind == "prismatic") && limit.number("lower", 0) >= limit.number("upper", 0))
      source_.left_out.add("<limit> whose upper end is not above its lower one", limit.where());
  }
}

void Preparation::urdfBase(xml::Element root) {
  const auto base = rootOf(root);
  if (!base) return;  // MuJoCo says so
  source_.root = base->attribute("name");
  if (!options_.free_base) return;
  const SourceLocation where = base->where();
  if (source_.root == "world") {
    fail(kUnreadable, where, "--free-base cannot free the link 'world': its name says that it stands still",
         "give the link another name, or leave out --free-base");
    return;
  }
  root.addChild("link", where).setAttribute("name", "presa_world");
  xml::Element joint = root.addChild("joint", where);
  joint.setAttribute("name", "presa_world");
  joint.setAttribute("type", "floating");
  joint.addChild("parent", where).setAttribute("link", "presa_world");
  joint.addChild("child", where).setAttribute("link", source_.root);
  source_.root.clear();
}

// A file of a package lies in the package's folder, which is above the URDF.
std::string Preparation::urdfFile(const std::string& name, const SourceLocation& where) {
  constexpr std::string_view kFile = "file://";
  const fs::path home = fs::weakly_canonical(where.file).parent_path();
  if (strip_path_) return (home / mesh_folder_ / fs::path(name).filename()).string();
  for (const std::string_view scheme : {"package://", "model://"}) {
    if (!name.starts_with(scheme)) continue;
    const fs::path rest = fs::path(name.substr(scheme.size())).lexically_normal();
    const std::string package = rest.empty() ? "" : rest.begin()->string();
    for (fs::path folder = home; folder != folder.root_path(); folder = folder.parent_path()) {
      if (folder.filename() != package) continue;
      // the folder of a package is known by this file: what lies in it belongs together
      if (fs::exists(folder / "package.xml")) input::allowFolder(folder.string());
      return (folder.parent_path() / rest).string();
    }
    fail(kNoFile, where, "there is no folder '" + package + "' above this file, found " + quote(name),
         "a package is a folder of its name that contains the URDF");
    return {};
  }
  const std::string path = name.starts_with(kFile) ? name.substr(kFile.size()) : name;
  return (home / mesh_folder_ / path).string();
}

}  // namespace presa::robot
