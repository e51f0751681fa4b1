#pragma once
#include <optional>
#include <string>
#include <vector>

#include "framework/scene/load.h"
#include "framework/scene/xml/schema.h"
#include "framework/scene/xml/xml.h"

/// The steps of loading a scene or a rig, in the order in which loadScene takes them.
namespace presa {

/// The document format this release reads.
inline constexpr int kFormatMajor = 1;
inline constexpr int kFormatMinor = 0;
/// Major must be ours; a newer minor is read with a warning. `kind` is "scene" or "rig", `code` the number to report.
void checkVersion(const xml::Element& root, const std::string& kind, int code, Diagnostics& diagnostics);

/// The number in an attribute; none when it is not there.
inline std::optional<double> optionalNumber(const xml::Element& element, const std::string& attribute) {
  if (!element.hasAttribute(attribute)) return std::nullopt;
  return element.number(attribute, 0);
}

/// `path` as it stands in a file in `directory`, absolute and without . and ..; "" stays "".
std::string resolvePath(const std::string& path, const std::string& directory);

/// Writes each override into the document; a path that leads nowhere is an error E202.
void applyOverrides(const xml::Element& root, const xml::ElementRule& rule, const std::vector<Override>& overrides,
                    Diagnostics& diagnostics);
/// Resolved document without errors to plain data.
Scene readScene(const xml::Element& root, const std::string& file, const std::string& directory);
/// What no schema can say: references, and values that depend on each other (E2xx).
void checkScene(const xml::Element& root, Diagnostics& diagnostics);
/// The same of <assembly>: bodies and goals that it names, and whether they can be put together in any order.
void checkAssembly(const xml::Element& root, Diagnostics& diagnostics);
/// The <words> of an assembly, or of a file of their own: elements of one name (E218), places in a phrase that nothing fills (E219).
void checkWords(const xml::Element& words, Diagnostics& diagnostics);
/// Of a document whose defaults are written.
AssemblyWords readWords(const xml::Element& words);
/// Two orientations, or one that is none.
void checkOrientation(const xml::Element& element, Diagnostics& diagnostics);
/// Writes defaults, chosen materials and absolute paths into a document without errors.
void resolveScene(xml::Document& document, const xml::Schema& schema, const std::string& directory);

/// The <bus> of a scene or a rig; none when it has none.
std::optional<BusSettings> readBus(const xml::Element& root);
/// E751: a scene, which may come from anybody, may publish on this machine, and neither open the network nor take commands.
void checkSceneBus(const xml::Element& root, Diagnostics& diagnostics);

/// All materials of the document, in order.
std::vector<xml::Element> materialElements(const xml::Element& root);
/// All device roles of the document, in order.
std::vector<xml::Element> deviceElements(const xml::Element& root);

}  // namespace presa
