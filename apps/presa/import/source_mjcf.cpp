#include <algorithm>
#include <cctype>

#include "apps/presa/import/codes.h"
#include "apps/presa/import/preparation.h"
#include "framework/input/folders.h"
#include "framework/scene/scene_parts.h"

// Only elements of known names reach MuJoCo: it would open files that others name.
namespace presa::robot {
namespace {

namespace fs = std::filesystem;

/// MuJoCo takes <Include> for <include>.
bool isInclude(const xml::Element& element) {
  std::string name = element.name();
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name == "include";
}

/// Elements that stand for bodies: without them, something would be missing rather than left out.
bool makesBodies(const xml::Element& element) {
  static const std::set<std::string> kMakers{"composite", "flexcomp", "frame", "replicate", "attach"};
  return kMakers.contains(element.name());
}

}  // namespace

void Preparation::mjcf(xml::Element root) {
  source_.name = root.attribute("model");
  included_.insert(fs::weakly_canonical(file_).string());
  mjcfIncludes(root);
  if (diagnostics_.hasErrors()) return;
  keepOnly(root, {"compiler", "option", "default", "asset", "worldbody"});
  compiler(root);
  mjcfOptions(root);
  for (const xml::Element& of : root.children("default")) mjcfDefaults(of);
  mjcfAssets(root);
  for (const xml::Element& world : root.children("worldbody")) mjcfBody(world);
}

void Preparation::mjcfIncludes(const xml::Element& in) {
  for (const xml::Element& child : in.children()) {
    if (diagnostics_.hasErrors()) return;
    if (!isInclude(child))
      mjcfIncludes(child);
    else if (!mjcfInclude(child))
      return;
  }
}

// Names count from the folder of the first file; each file is included once, as MuJoCo demands.
bool Preparation::mjcfInclude(const xml::Element& include) {
  const SourceLocation where = include.where("file");
  const std::string file = (fs::path(file_).parent_path() / include.attribute("file")).string();
  if (!input::checkNamed(where, file, diagnostics_)) return false;
  std::error_code error;
  if (!fs::exists(file, error))
    return fail(kNoFile, where, "there is no file " + quote(file), "names are relative to the first file");
  if (!included_.insert(fs::weakly_canonical(file).string()).second)
    return fail(kNoFile, where, quote(file) + " is included a second time", "include each file once");
  const auto included = xml::Document::load(file, diagnostics_);
  if (included == nullptr) return false;
  mjcfIncludes(included->root());
  elements_ += elementsIn(included->root());
  if (elements_ > kMostCopied)
    return fail(kNoFile, where, "included files have more than " + std::to_string(kMostCopied) + " elements");
  xml::Element here = include;
  for (const xml::Element& part : included->root().children()) here.insertCopy(part);
  here.remove();
  return true;
}

// Gravity counts; the rest is about MuJoCo's own solver.
void Preparation::mjcfOptions(const xml::Element& root) {
  for (xml::Element option : root.children("option")) {
    for (const std::string& name : option.attributeNames())
      if (name != "gravity") option.removeAttribute(name);
    for (xml::Element child : option.children()) {
      if (child.name() != "flag") {
        child.remove();
        continue;
      }
      for (const std::string& name : child.attributeNames())
        if (name != "gravity") leaveOut(child, name, "flag " + name + " of <option>");
    }
  }
}

void Preparation::mjcfAssets(const xml::Element& root) {
  for (const xml::Element& assets : root.children("asset")) {
    keepOnly(assets, {"mesh", "material"});
    for (const xml::Element& material : assets.children("material")) leaveOut(material, "texture", "<texture>");
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
  if (body.hasAttribute("gravcomp")) {  // a later version of MJCF has it
    if (!body.hasAttribute("name"))
      body.setAttribute("name", "presa_carried_" + std::to_string(source_.carried.size() + 1));
    source_.carried[body.attribute("name")] = body.number("gravcomp", 0);
    body.removeAttribute("gravcomp");
  }
  for (const xml::Element& child : body.children()) {
    if (makesBodies(child)) {
      fail(kUnreadable, child.where(), "<" + child.name() + "> is not read: it stands for bodies",
           "MuJoCo writes the model without it: save it as XML there");
    } else if (child.name() == "geom" && (child.attribute("type") == "hfield" || child.hasAttribute("hfield"))) {
      source_.left_out.add("<geom type=\"hfield\">", child.where());
      xml::Element(child).remove();
    }
  }
  keepOnly(body, {"body", "joint", "freejoint", "geom", "inertial"});
  for (const xml::Element& child : body.children("body")) mjcfBody(child);
}

// Defaults of what is left out go without a word.
void Preparation::mjcfDefaults(const xml::Element& of) {
  static const Names kKept{"default", "joint", "geom", "mesh", "material"};
  for (xml::Element child : of.children()) {
    if (!kKept.contains(child.name())) {
      child.remove();
      continue;
    }
    if (child.name() == "material") leaveOut(child, "texture", "<texture>");
    if (child.name() == "geom" && child.attribute("type") == "hfield") child.removeAttribute("type");
    if (child.name() == "default") mjcfDefaults(child);
  }
}

}  // namespace presa::robot
