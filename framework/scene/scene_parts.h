#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "framework/scene/load.h"
#include "framework/scene/xml/schema.h"
#include "framework/scene/xml/xml.h"

/// The steps of loading a scene or a rig, in the order in which loadScene runs them.
namespace presa {

/// The document format this release reads.
inline constexpr int kFormatMajor = 1;
inline constexpr int kFormatMinor = 1;  ///< the second number of the format
/// The major version must match; a newer minor version gives a warning. `kind`: "scene" or "rig"; `code`: number to
/// report.
void checkVersion(const xml::Element& root, const std::string& kind, int code, Diagnostics& diagnostics);

/// Turns a scene of an older format 1.x into one of this release; other texts stay as they are.
void upgrade(xml::Element root);

/// The number in an attribute, or none when the attribute is absent.
inline std::optional<double> optionalNumber(const xml::Element& element, const std::string& attribute) {
  if (!element.hasAttribute(attribute)) return std::nullopt;
  return element.number(attribute, 0);
}

/// `path` relative to `directory`, made absolute and normalised; "" stays "".
std::string resolvePath(const std::string& path, const std::string& directory);

/// Elements that `<include>` or `<defaults>` of a scene may bring in all copies together.
inline constexpr std::size_t kMostCopied = 200'000;
/// The element and all in it.
std::size_t elementsIn(const xml::Element& element);
/// Copies what the files of `<include>` elements hold in front of these elements (E273 to E275). Files are read only on
/// behalf of a document that was a file itself: `from_file`. Each file's `<defaults>` are for what stands in it.
void expandIncludes(xml::Document& document, const xml::ElementRule& scene, bool from_file, Diagnostics& diagnostics);
/// Gives bodies, joints, materials and devices what `<defaults>` has for them and they lack, and takes `<defaults>` and
/// every attribute `class` out. `scene`: rule of the root. E277 unknown class, E278 what `<defaults>` cannot hold, W279 a
/// class that nothing has.
void applyDefaults(const xml::Element& root, const xml::ElementRule& scene, Diagnostics& diagnostics);
/// The alternative of an attribute (mass and density, euler_deg and quat, preset and static), or "": one of them alone
/// may be given.
std::string rivalOf(const std::string& attribute);
/// Takes the `<include>` elements themselves out, after they have been validated.
void removeIncludes(const xml::Element& root);
/// Writes each override into the document; an unknown path is error E202.
void applyOverrides(const xml::Element& root, const xml::ElementRule& rule, const std::vector<Override>& overrides,
                    Diagnostics& diagnostics);
/// Writes the coefficient of each `<friction preset="…">` in its place; E236 beside a static one.
void resolveFrictionPresets(const xml::Element& root, Diagnostics& diagnostics);
/// Reads a resolved document without errors into plain data.
Scene readScene(const xml::Element& root, const std::string& file, const std::string& directory);
/// Whether `<dynamics>` of a document states the coupling.
bool statesCoupling(const xml::Element& root);
/// A part of a scene that does not go with the coupling `haptic_rate`.
struct CouplingObstacle {
  SourceLocation where;  ///< of its attribute or element
  std::string found;     ///< "solver="direct""
  std::string allowed;   ///< as in error E228
};
/// The haptic thread has Presa's own solvers only, and no snap constraints.
std::vector<CouplingObstacle> obstaclesToHapticRate(const xml::Element& root);
/// Gives a scene that states no coupling `haptic_rate` instead of `soft`, and writes it into the document, if the force
/// on a free body changes within a step of the dynamics (an element whose manifest says quick="true", a stiff surface, a
/// quick spin), and the haptic thread can move the scene's bodies.
void chooseCoupling(Scene& scene, const xml::Element& root);
/// Checks rules that a schema cannot express: references, and values that depend on each other (E2xx).
void checkScene(const xml::Element& root, Diagnostics& diagnostics);
/// Checks `<assembly>`: the bodies and goals it refers to, and whether the goals can be filled in some order.
void checkAssembly(const xml::Element& root, Diagnostics& diagnostics);
/// Warns about values that can be simulated, but are hardly meant: outside of the ranges in CONTRIBUTING.md (W227).
void checkSaneRanges(const xml::Element& element, Diagnostics& diagnostics);
/// Checks the `<words>` of an assembly or of a separate file: duplicate elements (E203), unknown placeholders (E219).
void checkWords(const xml::Element& words, Diagnostics& diagnostics);
/// Reads `<words>` from a document with written defaults.
AssemblyWords readWords(const xml::Element& words);
/// Reports two orientations on one element (E211) and a zero quaternion (E212).
void checkOrientation(const xml::Element& element, Diagnostics& diagnostics);
/// Pose of an element with attributes pos, euler_deg, quat.
Pose readPose(const xml::Element& element);
/// Checks the `<frame>` elements of a rig and what stands in them (E416 to E419).
void checkFrames(const xml::Element& root, Diagnostics& diagnostics);
/// The frames of a rig with written defaults, without errors.
std::vector<Frame> readFrames(const xml::Element& root);
/// Writes defaults, implied materials and absolute paths into a document without errors.
void resolveScene(xml::Document& document, const xml::Schema& schema, const std::string& directory);
/// Makes the paths of the rig, of meshes and of plug-ins' files absolute.
void resolveFiles(const xml::Element& root, const std::string& directory);

/// The elements that plug-ins bring, in the scene itself and in its bodies.
std::vector<PluginElement> readPluginElements(const xml::Element& root);
/// Makes the files that such elements name absolute.
void resolvePluginFiles(const xml::Element& root, const std::string& directory);
/// Calls visit(element, attribute) for each attribute of a plug-in's element that names a material.
void forEachMaterialNamed(const xml::Element& root,
                          const std::function<void(const xml::Element&, const std::string&)>& visit);
/// Attributes of type "file" of the element that have a value.
std::vector<std::string> filesNamedBy(const PluginElement& element);

/// The `<bus>` of a scene or a rig, or none.
std::optional<BusSettings> readBus(const xml::Element& root);
/// E751: a scene may come from an untrusted source. It may publish on this machine, but neither open the network nor
/// take commands.
void checkSceneBus(const xml::Element& root, Diagnostics& diagnostics);

/// All materials of the document, in order.
std::vector<xml::Element> materialElements(const xml::Element& root);
/// All device roles of the document, in order.
std::vector<xml::Element> deviceElements(const xml::Element& root);

}  // namespace presa
