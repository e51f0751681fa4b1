#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "framework/input/folders.h"
#include "framework/scene/scene_parts.h"
#include "framework/scene/xml/value_rule.h"

namespace presa {
namespace {

namespace fs = std::filesystem;
using xml::Element;

enum IncludeCode { kNotIncluded = 273, kEndless = 274, kStays = 275 };

constexpr std::size_t kDeepest = 8;  // files that include each other

std::string join(const Vec3& v) {
  return xml::numberText(v.x()) + " " + xml::numberText(v.y()) + " " + xml::numberText(v.z());
}

/// The copies of one file, and what its <include> changes in them.
class Included {
 public:
  Included(const Element& include, const Element& root)
      : include_(include), root_(root), prefix_(include.attribute("prefix")), X_(readPose(include)) {
    moved_ = include.hasAttribute("pos") || include.hasAttribute("euler_deg") || include.hasAttribute("quat");
    for (const Element& material : materialElements(root)) {
      if (first_material_.empty()) first_material_ = prefix_ + material.attribute("name");
    }
  }

  void copyInto(Element to, Diagnostics& diagnostics) {
    copyMaterials(to);
    for (const Element& element : root_.children()) {
      static const std::set<std::string> kOwn{"world", "rates",     "haptics", "collision", "dynamics",
                                              "bus",   "materials", "devices", "assembly"};
      if (kOwn.contains(element.name())) continue;  // of the scene that includes
      if (element.name() == "body") {
        adaptBody(include_.insertCopy(element));
      } else if (element.name() == "joint") {
        adaptJoint(include_.insertCopy(element));
      } else if (element.name() == "include") {
        include_.insertCopy(element);  // has been expanded: it is validated
      } else if (moved_ || !prefix_.empty()) {
        diagnostics.error(kStays, element.where(),
                          element.label() + " cannot be moved or renamed with the file that " + include_.where().file +
                              ":" + std::to_string(include_.where().line) + " includes",
                          "write it in that scene, or include the file without prefix, pos and orientation");
      } else {
        include_.insertCopy(element);
      }
    }
  }

 private:
  void rename(Element element, const char* attribute) const {
    if (!prefix_.empty() && element.hasAttribute(attribute))
      element.setAttribute(attribute, prefix_ + element.attribute(attribute));
  }

  void copyMaterials(Element to) {
    const std::vector<Element> lists = root_.children("materials");
    if (lists.empty()) return;
    std::vector<Element> own = to.children("materials");
    if (own.empty()) own.push_back(to.addChild("materials", lists[0].where()));
    for (const Element& material : materialElements(root_)) rename(own[0].addCopy(material), "name");
  }

  void adaptBody(Element body) const {
    rename(body, "name");
    if (body.hasAttribute("material")) {
      rename(body, "material");
    } else if (!first_material_.empty()) {
      body.setAttribute("material", first_material_, body.where());
    }
    if (!moved_) return;
    const Pose X_WB = X_ * readPose(body);
    body.setAttribute("pos", join(X_WB.p));
    body.removeAttribute("euler_deg");
    body.setAttribute("quat", xml::numberText(X_WB.q.w()) + " " + join(X_WB.q.vec()), body.where());
    for (const char* vector : {"velocity", "angular_velocity"}) turn(body, vector);
    for (const Element& physics : body.children("physics")) turn(physics, "force");
  }

  void turn(Element element, const char* vector) const {
    const std::vector<double> v = element.numbers(vector);
    if (v.size() == 3) element.setAttribute(vector, join(X_.q * Vec3(v[0], v[1], v[2])));
  }

  void adaptJoint(const Element& joint) const {
    for (const char* name : {"name", "body", "to"}) rename(joint, name);
  }

  Element include_, root_;
  std::string prefix_, first_material_;
  Pose X_;
  bool moved_ = false;
};

class Expansion {
 public:
  Expansion(const xml::ElementRule& scene, Diagnostics& diagnostics) : scene_(scene), diagnostics_(diagnostics) {}

  void expand(Element root, const std::string& file) {
    open_.push_back(fs::weakly_canonical(file).string());
    for (const Element& include : root.children("include")) {
      if (flooded_) break;
      if (include.hasAttribute("file"))
        expandOne(root, include, resolvePath(include.attribute("file"), folderOf(file)));
    }
    open_.pop_back();
  }

 private:
  static std::string folderOf(const std::string& file) { return fs::path(file).parent_path().string(); }

  static bool isPlaced(const Element& include) {
    return std::ranges::all_of(
        std::vector{std::pair{"pos", 3UL}, {"euler_deg", 3UL}, {"quat", 4UL}},
        [&](const auto& a) { return !include.hasAttribute(a.first) || include.numbers(a.first).size() == a.second; });
  }

  /// The root of an included file is not copied, so validation does not see its version.
  static bool isReadable(const Element& root) {
    return root.attribute("version").starts_with(std::to_string(kFormatMajor) + ".");
  }

  void refuse(int code, const Element& include, const std::string& what, const std::string& help) {
    diagnostics_.error(code, include.where("file"), what, help);
  }

  void expandOne(Element root, const Element& include, const std::string& file) {
    std::error_code missing;
    const std::size_t before = diagnostics_.errorCount();
    checkOrientation(include, diagnostics_);
    if (diagnostics_.errorCount() > before || !isPlaced(include)) return;  // validation tells of numbers that are none
    if (!input::checkNamed(include.where("file"), file, diagnostics_)) return;
    if (!fs::exists(file, missing))
      return refuse(kNotIncluded, include, "there is no file " + file, "paths are relative to the file that includes");
    if (std::ranges::find(open_, fs::weakly_canonical(file).string()) != open_.end())
      return refuse(kEndless, include, file + " includes itself", "leave one of the includes out");
    if (open_.size() > kDeepest)
      return refuse(kEndless, include,
                    "files include each other " + std::to_string(open_.size()) + " deep, up to " +
                        std::to_string(kDeepest) + " are read",
                    "include the innermost file here");
    const auto document = xml::Document::load(file, diagnostics_);
    if (!document) return;
    if (document->root().name() != "scene")
      return refuse(kNotIncluded, include, file + " is no scene: its root is <" + document->root().name() + ">",
                    "bodies, joints and materials stand in <scene>");
    if (!isReadable(document->root()))
      return refuse(kNotIncluded, include,
                    file + " is not written in format " + std::to_string(kFormatMajor) + ".x, which this release reads",
                    "presa check " + file + " tells what is wrong with it");
    upgrade(document->root());
    applyDefaults(document->root(), scene_, diagnostics_);
    expand(document->root(), file);
    resolveFiles(document->root(), folderOf(file));
    if (flooded_) return;
    elements_ += elementsIn(document->root());
    flooded_ = elements_ > kMostCopied;
    if (flooded_)
      return refuse(kEndless, include,
                    "with this file, includes bring more than " + std::to_string(kMostCopied) + " elements",
                    "include fewer or smaller files");
    Included(include, document->root()).copyInto(root, diagnostics_);
  }

  const xml::ElementRule& scene_;
  Diagnostics& diagnostics_;
  std::vector<std::string> open_;  // files that are being expanded, the outermost first
  std::size_t elements_ = 0;
  bool flooded_ = false;
};

}  // namespace

std::size_t elementsIn(const xml::Element& element) {
  std::size_t count = 1;
  for (const Element& child : element.children()) count += elementsIn(child);
  return count;
}

void expandIncludes(xml::Document& document, const xml::ElementRule& scene, bool from_file, Diagnostics& diagnostics) {
  const std::vector<Element> includes = document.root().children("include");
  if (includes.empty()) return;
  if (from_file) return Expansion(scene, diagnostics).expand(document.root(), document.name());
  diagnostics.error(kNotIncluded, includes[0].where(), "only a scene in a file may include others",
                    "write the scene to a file");
}

void removeIncludes(const xml::Element& root) {
  for (Element include : root.children("include")) include.remove();
}

}  // namespace presa
