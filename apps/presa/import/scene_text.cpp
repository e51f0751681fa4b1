#include "apps/presa/import/scene_text.h"

#include <algorithm>
#include <set>

#include "apps/common/scene_name.h"
#include "apps/common/terminal/text.h"
#include "apps/presa/import/codes.h"
#include "apps/presa/import/joint_text.h"
#include "apps/presa/import/solids.h"
#include "framework/geometry/convex.h"
#include "framework/geometry/obj_text.h"
#include "framework/scene/scene_parts.h"
#include "framework/scene/xml/escaped.h"
#include "framework/scene/xml/value_rule.h"

namespace presa::robot {
namespace {

using terminal::format;

constexpr std::size_t kMaxShapes = 256;        // of one physics geometry
constexpr std::size_t kMaxHullVertices = 256;  // of the convex hull of a mesh
constexpr int kDigits = 9;
constexpr double kMostCarried = 1000;  // max_force of <gravity_compensation> [N]

/// Names that scenes allow, different for each call.
class Names {
 public:
  std::string unique(const std::string& wanted, const std::string& otherwise) {
    const std::string name = sceneName(wanted.empty() ? otherwise : wanted);
    std::string free = name;
    for (int& i = numbers_[name]; !taken_.insert(free).second;) free = name + "_" + std::to_string(++i + 1);
    return free;
  }

 private:
  std::set<std::string> taken_;
  std::map<std::string, int> numbers_;  ///< last one behind each name
};

class Writer {
 public:
  Writer(const Robot& robot, const SceneSettings& settings, Diagnostics& diagnostics)
      : robot_(robot), settings_(settings), diagnostics_(diagnostics) {}

  SceneFiles files() {
    if (robot_.masked)
      files_.notes.push_back(
          "contype and conaffinity keep some solids apart in the file; in the scene all of them meet");
    std::string bodies = staticBodies();
    for (std::size_t i = 1; i < robot_.links.size(); ++i) {
      names_of_.resize(i + 1);
      const Link& link = robot_.links[i];
      if (link.parent == 0 && link.freedoms.empty()) {  // moved by its user in MuJoCo
        if (!link.parts.empty()) bodies += staticBody(link.parts, link.name, link.X_WL);
        continue;
      }
      names_of_[i] = names_.unique(link.name, "link_" + std::to_string(i));
      bodies += linkBody(link, names_of_[i]);
      addJoint(i);
    }
    files_.scene = head() + materials_text_ + "  </materials>\n" + bodies + joints_ +
                   "  <devices>\n    <device role=\"thumb\"/>\n    <device role=\"index\"/>\n  </devices>\n</scene>\n";
    files_.others[settings_.name + "_rig.xml"] =
        rig("_rig", "Mouse and keys of the window move both fingers.", "driver=\"pointer\"/>");
    files_.others[settings_.name + "_away.xml"] =
        rig("_away", "Both fingers stay above the bodies: for runs without a window.",
            "driver=\"scripted\"><set key=\"motion\" value=\"" + settings_.name + "_away.csv\"/></device>");
    files_.others[settings_.name + "_away.csv"] = awayMotion();
    return std::move(files_);
  }

 private:
  std::string head() const {
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<scene version=\"" + std::to_string(kFormatMajor) + "." +
           std::to_string(kFormatMinor) + "\" name=\"" + settings_.name + "\" rig=\"" + settings_.name +
           "_rig.xml\"\n       description=\"Imported from " + xml::escaped(settings_.source) + "\">\n  <world" +
           vectorText("gravity", robot_.gravity) + "/>\n  <materials>\n";
  }

  std::string rig(const std::string& kind, const std::string& comment, const std::string& device) const {
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- " + comment + " -->\n<rig version=\"1.0\" name=\"" +
           settings_.name + kind + "\">\n  <device role=\"thumb\" " + device + "\n  <device role=\"index\" " + device +
           "\n</rig>\n";
  }

  /// Keyframes for ten seconds, half a metre above the highest link.
  std::string awayMotion() const {
    double top = 0;
    for (const Link& link : robot_.links) top = std::max(top, link.X_WL.p.z());
    std::string text = "time_s,role,x_m,y_m,z_m,phase\n";
    for (const int time : {0, 10})
      for (const auto& [role, x] : {std::pair{"thumb", -0.05}, {"index", 0.05}})
        text += format("%d,%s,%g,0,%.3f,wait\n", time, role, x, top + 0.5);
    return text;
  }

  /// The name of the material with this part's friction and colour.
  std::string materialOf(const Part& part) {
    std::string text = numberText("stiffness", settings_.stiffness) +
                       format(" color=\"%.3g %.3g %.3g\"", part.color.x(), part.color.y(), part.color.z());
    text += part.friction > 0 ? ">\n      <friction" + numberText("static", part.friction) + "/>\n    </material>\n"
                              : "/>\n";
    const auto [known, is_new] = materials_.try_emplace(text, "material_" + std::to_string(materials_.size() + 1));
    if (is_new) materials_text_ += "    <material name=\"" + known->second + "\"" + text;
    return known->second;
  }

  std::string file(const std::string& name, const std::string& text) {
    const std::string path = "meshes/" + name + ".obj";
    files_.others[path] = text;
    return "<mesh file=\"" + path + "\"/>";
  }

  static bool isPrimitive(const Part& part) { return !primitiveText(part).empty(); }

  /// A geometry of one shape: <haptic …><box …/></haptic>.
  static std::string one(const std::string& element, const std::string& attributes, const Part& part) {
    return "    <" + element + attributes + poseText(placeOf(part)) + ">" + primitiveText(part) + "</" + element +
           ">\n";
  }

  std::string visual(const std::vector<Part>& drawn, const std::string& body) {
    if (drawn.size() == 1 && isPrimitive(drawn[0])) return one("visual", "", drawn[0]);
    return "    <visual>" + file(body + "_drawn", coloredObj(drawn, robot_)) + "</visual>\n";
  }

  /// What fingers feel: the surface, or where a mesh of the file is open, its convex hull.
  std::string haptic(const std::vector<Part>& solid, const std::string& body) {
    if (solid.size() == 1 && isPrimitive(solid[0])) return one("haptic", "", solid[0]);
    std::vector<TriMesh> felt;
    for (const Part& part : solid) {
      TriMesh mesh = surfaceOf(part, robot_);
      if (part.solid == Solid::kMesh && !isSound(mesh)) {
        mesh = hullOf(part);
        files_.notes.push_back("'" + body + "': fingers feel the convex hull of mesh '" + robot_.names[part.mesh] +
                               "', which is not closed");
      }
      felt.push_back(std::move(mesh));
    }
    return "    <haptic>" + file(body + "_felt", objText(together(felt), kDigits)) + "</haptic>\n";
  }

  static bool isSound(const TriMesh& mesh) {
    const MeshReport report = checkMesh(mesh);
    return report.closed() && report.flipped_edges == 0 && report.degenerate == 0 && !report.inverted;
  }

  TriMesh hullOf(const Part& part) const {
    const TriMesh mesh = surfaceOf(part, robot_);
    return convexHull(mesh.vertices, kMaxHullVertices).value_or(mesh);
  }

  std::string physics(const std::vector<Part>& solid, const std::string& attributes, const std::string& body) {
    if (solid.size() == 1 && isPrimitive(solid[0])) return one("physics", attributes, solid[0]);
    std::string text = "    <physics" + attributes + ">\n";
    for (std::size_t i = 0; i < std::min(solid.size(), kMaxShapes); ++i) {
      const Part& part = solid[i];
      const std::string numbered = body + "_piece_" + std::to_string(i + 1);
      text += "      " +
              (isPrimitive(part) ? primitiveText(part, poseText(placeOf(part)))
                                 : file(numbered, objText(hullOf(part), kDigits))) +
              "\n";
    }
    if (solid.size() > kMaxShapes)
      files_.notes.push_back(format("'%s': only the first %zu of its %zu solids collide with bodies", body.c_str(),
                                    kMaxShapes, solid.size()));
    return text + "    </physics>\n";
  }

  /// What stands still: the root link as one body, or a body for each solid of a model without one.
  std::string staticBodies() {
    const std::vector<Part>& parts = robot_.links[0].parts;
    if (parts.empty()) return {};
    if (!settings_.root.empty()) return staticBody(parts, settings_.root, {});
    std::string bodies;
    for (const Part& part : parts) {
      Part own = part;
      own.X_LG = {};
      bodies += staticBody({own}, part.name, part.X_LG);
    }
    return bodies;
  }

  std::string staticBody(const std::vector<Part>& parts, const std::string& wanted, const Pose& X_WB) {
    const std::string name = names_.unique(wanted, "static");
    const auto [solid, drawn] = sorted(parts);
    std::string body = "  <body name=\"" + name + "\" fixed=\"true\" material=\"" +
                       materialOf(solid.empty() ? drawn.front() : solid.front()) + "\"" + poseText(X_WB) + ">\n";
    noteFrictions(solid, name);
    noteEnds(parts, name);
    if (!drawn.empty() || hasColours(solid)) body += visual(drawn.empty() ? solid : drawn, name);
    if (!solid.empty()) body += haptic(solid, name) + physics(solid, "", name);
    return body + "  </body>\n";
  }

  static bool hasColours(const std::vector<Part>& parts) {
    return std::ranges::any_of(parts, [&](const Part& part) { return part.color != parts.front().color; });
  }

  void noteEnds(const std::vector<Part>& parts, const std::string& body) {
    if (std::ranges::any_of(parts,
                            [](const Part& p) { return p.solid == Solid::kPlane && p.size.head<2>().minCoeff() <= 0; }))
      files_.notes.push_back("'" + body + "': a plane without end is 10 m wide");
  }

  struct Sorted {
    std::vector<Part> solid, drawn;
  };
  static Sorted sorted(const std::vector<Part>& parts) {
    Sorted sorted;
    for (const Part& part : parts) (part.collides ? sorted.solid : sorted.drawn).push_back(part);
    return sorted;
  }

  std::string linkBody(const Link& link, const std::string& name) {
    auto [solid, drawn] = sorted(link.parts);
    const std::vector<Part> felt = solid;
    if (solid.empty()) solid.push_back(ballOf(link, name));
    noteFrictions(solid, name);
    const Part& first = felt.empty() && !drawn.empty() ? drawn.front() : solid.front();
    std::string text =
        "  <body name=\"" + name + "\" material=\"" + materialOf(first) + "\"" + poseText(link.X_WL) + ">\n";
    if (!drawn.empty() || hasColours(felt)) text += visual(drawn.empty() ? felt : drawn, name);
    if (!felt.empty()) text += haptic(felt, name);
    return text + physics(solid, inertiaText(link), name) + carried(link) + "  </body>\n";
  }

  /// A share above 1 would lift the link: it ends at 1, with a note.
  std::string carried(const Link& link) {
    const auto found = settings_.carried.find(link.name);
    if (found == settings_.carried.end() || found->second <= 0) return {};
    if (found->second > 1) files_.notes.push_back("'" + link.name + "': gravcomp counts up to 1");
    const double weight = link.mass * robot_.gravity.norm();
    if (weight > kMostCarried) files_.notes.push_back("'" + link.name + "': gravcomp carries up to 1000 N");
    return "    <gravity_compensation" + numberText("share", std::min(1.0, found->second)) +
           numberText("max_force", std::clamp(2 * weight, 1.0, kMostCarried)) + "/>\n";
  }

  static std::string inertiaText(const Link& link) {
    const Mat3& m = link.inertia_L;
    std::string inertia;
    for (const double moment : {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(0, 2), m(1, 2)})
      inertia += (inertia.empty() ? "" : " ") + xml::numberText(moment);
    return numberText("mass", link.mass) + vectorText("center", link.com_L) + " inertia=\"" + inertia + "\"";
  }

  /// A link without solids that collide: the ball that has its largest moment of inertia, about its centre of mass.
  Part ballOf(const Link& link, const std::string& body) {
    Part ball;
    ball.solid = Solid::kSphere;
    const double moment = link.inertia_L.diagonal().maxCoeff();
    ball.size.x() = std::clamp(std::sqrt(2.5 * moment / std::max(link.mass, 1e-9)), 0.001, 0.1);
    ball.X_LG.p = link.com_L;
    ball.color = Vec3::Constant(0.5);
    ball.collides = true;
    files_.notes.push_back("'" + body + "' has no solid that collides; bodies meet a ball of " +
                           format("%.3g", 1e3 * ball.size.x()) + " mm about its centre of mass");
    return ball;
  }

  void noteFrictions(const std::vector<Part>& solid, const std::string& body) {
    if (std::ranges::any_of(solid, [&](const Part& p) { return p.friction != solid.front().friction; }))
      files_.notes.push_back("'" + body + "': all of it has the friction of its first solid");
  }

  void addJoint(std::size_t i) {
    const Link& link = robot_.links[i];
    const std::string to = names_of_[link.parent];  // empty: it hangs on what stands still
    const std::string wanted = link.freedoms.empty() ? "" : link.freedoms.front().name;
    const std::string name = joint_names_.unique(wanted, names_of_[i] + "_joint");
    const auto joint = jointOf(link, name, names_of_[i], to);
    if (!joint) {
      diagnostics_.error(kNoSuchJoint, settings_.where(link.name),
                         "body '" + link.name + "' has " + std::to_string(link.freedoms.size()) +
                             " joints with its parent, and no joint of Presa moves like them",
                         "fixed, hinge, slider, ball, universal (two hinges square to each other, through one point), "
                         "prismatic_rotary (a slide and a hinge)");
      return;
    }
    joints_ += joint->text;
    files_.notes.insert(files_.notes.end(), joint->notes.begin(), joint->notes.end());
  }

  const Robot& robot_;
  const SceneSettings& settings_;
  Diagnostics& diagnostics_;
  SceneFiles files_;
  Names names_, joint_names_;
  std::vector<std::string> names_of_{""};  ///< body of each link
  std::map<std::string, std::string> materials_;
  std::string materials_text_, joints_;
};

}  // namespace

SceneFiles sceneOf(const Robot& robot, const SceneSettings& settings, Diagnostics& diagnostics) {
  return Writer(robot, settings, diagnostics).files();
}

}  // namespace presa::robot
