#include "framework/scene/manifest.h"

#include <algorithm>
#include <filesystem>
#include <map>

#include "framework/core/plugin/plugin_loader.h"
#include "framework/scene/schemas.h"
#include "framework/scene/xml/schema.h"
#include "framework/scene/xml/xml.h"

namespace presa {
namespace {

namespace fs = std::filesystem;

enum Code { kBroken = 593, kTaken = 594, kAgainstKind = 595 };

constexpr const char* kPrefix = "presa_";

Manifest::Attribute readAttribute(const xml::Element& element) {
  return {element.attribute("name"),  element.attribute("type"),        element.attribute("unit"),
          element.attribute("about"), !element.hasAttribute("default"), element.attribute("default"),
          element.attribute("above"), element.attribute("min"),         element.attribute("max")};
}

Manifest::Place placeOf(const std::string& name) {
  using Place = Manifest::Place;
  return name == "body" ? Place::kBody : name == "friction" ? Place::kFriction : Place::kScene;
}

Manifest read(const xml::Element& root, const std::string& file) {
  const PluginKind kind =
      root.attribute("kind") == "friction_law" ? PluginKind::kFrictionLaw : PluginKind::kForceEffect;
  Manifest manifest{root.attribute("name"), root.attribute("version"), kind, root.attribute("about"), {}, file};
  for (const xml::Element& child : root.children("element")) {
    Manifest::Element element{child.attribute("name"), placeOf(child.attribute("in")), {}, child.where()};
    for (const xml::Element& attribute : child.children("attribute"))
      element.attributes.push_back(readAttribute(attribute));
    manifest.elements.push_back(std::move(element));
  }
  return manifest;
}

/// A friction law belongs to a material's friction, a force effect to a body or the scene.
void checkPlace(const Manifest& manifest, const Manifest::Element& element, Diagnostics& diagnostics) {
  const bool friction = manifest.kind == PluginKind::kFrictionLaw;
  if (friction == (element.place == Manifest::Place::kFriction)) return;
  diagnostics.error(kAgainstKind, element.where,
                    "<" + element.name + "> of the " + nameOf(manifest.kind) + " '" + manifest.name +
                        "' cannot stand in=\"" + nameOf(element.place) + "\"",
                    friction ? "in=\"friction\"" : "in=\"body\" or in=\"scene\"");
}

void checkElements(const Manifest& manifest, Diagnostics& diagnostics) {
  for (const Manifest::Element& element : manifest.elements) {
    checkPlace(manifest, element, diagnostics);
    if (manifest.kind != PluginKind::kForceEffect) continue;
    const bool bounded = std::ranges::any_of(element.attributes, [](const Manifest::Attribute& attribute) {
      return attribute.name == "max_force" && attribute.type == "number" && attribute.required;
    });
    if (!bounded) {
      diagnostics.error(
          kAgainstKind, element.where,
          "<" + element.name + "> of the force effect '" + manifest.name + "' has no required number max_force",
          "the scene must bound every force effect; add <attribute name=\"max_force\" type=\"number\" "
          "unit=\"N\" above=\"0\" about=\"…\"/>");
    }
  }
}

std::optional<Manifest> readManifest(const fs::path& path, Diagnostics& diagnostics) {
  static const xml::Schema schema(schemas::plugin);
  const auto document = xml::Document::load(path.string(), diagnostics);
  if (!document || !document->validate(schema, diagnostics)) return std::nullopt;
  Manifest manifest = read(document->root(), path.string());
  if (path.filename() != kPrefix + manifest.name + ".xml") {
    diagnostics.error(kBroken, document->root().where("name"),
                      "the manifest of plug-in '" + manifest.name + "' lies in " + quote(path.filename().string()),
                      "call it presa_" + manifest.name + ".xml");
  }
  checkElements(manifest, diagnostics);
  return manifest;
}

/// Manifests by the name of their files; names in sorted order, so that nothing depends on a file system's order.
std::map<std::string, fs::path> manifestFiles(const std::vector<std::string>& folders) {
  std::map<std::string, fs::path> files;
  for (const std::string& folder : folders) {
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
      const std::string name = entry.path().filename().string();
      if (name.starts_with(kPrefix) && entry.path().extension() == ".xml") files.try_emplace(name, entry.path());
    }
  }
  return files;
}

/// Reports elements that exist already: Presa's own, or those of another plug-in.
void checkTaken(const std::vector<Manifest>& all, Diagnostics& diagnostics) {
  const xml::Schema own(schemas::scene);
  std::map<std::string, std::string> owners;
  for (const auto& rule : own.elements()) owners.try_emplace(rule->name, "Presa itself");
  for (const Manifest& manifest : all) {
    for (const Manifest::Element& element : manifest.elements) {
      const auto [taken, is_new] =
          owners.try_emplace(element.name, "plug-in '" + manifest.name + "' (" + manifest.file + ")");
      if (is_new) continue;
      diagnostics.error(
          kTaken, element.where,
          "plug-in '" + manifest.name + "' brings <" + element.name + ">, which " + taken->second + " brings already",
          "rename the element, or remove one of the two plug-ins");
    }
  }
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '"') {
      out += "&quot;";
    } else {
      out += c;
    }
  }
  return out;
}

std::string boundOf(const char* facet, const std::string& value) {
  return value.empty() ? "" : std::string("<xs:") + facet + " value=\"" + escaped(value) + "\"/>";
}

/// XSD name of an attribute's type. A bounded number gets a type of its own, added to `types`.
std::string typeOf(const Manifest::Element& element, const Manifest::Attribute& attribute, std::string& types) {
  if (attribute.type == "vector3") return "vector3";
  if (attribute.type == "boolean") return "xs:boolean";
  if (attribute.type == "name") return "xs:NCName";
  if (attribute.type == "text") return "xs:string";
  const std::string facets = boundOf("minExclusive", attribute.above) + boundOf("minInclusive", attribute.min) +
                             boundOf("maxInclusive", attribute.max);
  if (facets.empty()) return "xs:double";
  const std::string name = element.name + "." + attribute.name;
  types += "<xs:simpleType name=\"" + name + "\"><xs:restriction base=\"xs:double\">" + facets +
           "</xs:restriction></xs:simpleType>\n";
  return name;
}

std::string declarationOf(const Manifest::Element& element, std::string& types) {
  std::string out = "<xs:element name=\"" + element.name + "\" p:implied=\"false\"";
  if (element.place != Manifest::Place::kScene) out += " minOccurs=\"0\"";
  out += "><xs:complexType>";
  for (const Manifest::Attribute& attribute : element.attributes) {
    out += "<xs:attribute name=\"" + attribute.name + "\" type=\"" + typeOf(element, attribute, types) + "\"";
    out += attribute.required ? " use=\"required\"" : " default=\"" + escaped(attribute.default_value) + "\"";
    out += "><xs:annotation><xs:documentation>" + escaped(attribute.about) +
           (attribute.unit.empty() ? "" : " [" + escaped(attribute.unit) + "]") +
           "</xs:documentation></xs:annotation></xs:attribute>";
  }
  return out + "</xs:complexType></xs:element>\n";
}

void insertAt(std::string& xsd, const std::string& mark, const std::string& text) {
  const std::size_t at = xsd.find("<!-- " + mark + " -->");
  if (at == std::string::npos) throw std::logic_error("scene.xsd has no comment '" + mark + "'");
  xsd.insert(at, text);
}

}  // namespace

const char* nameOf(PluginKind kind) { return kind == PluginKind::kFrictionLaw ? "friction law" : "force effect"; }

const char* nameOf(Manifest::Place place) {
  switch (place) {
    case Manifest::Place::kBody:
      return "body";
    case Manifest::Place::kFriction:
      return "friction";
    default:
      return "scene";
  }
}

std::vector<Manifest> readManifests(const std::vector<std::string>& folders, Diagnostics& diagnostics) {
  std::vector<Manifest> all;
  for (const auto& [name, path] : manifestFiles(folders)) {
    if (auto manifest = readManifest(path, diagnostics)) all.push_back(std::move(*manifest));
  }
  checkTaken(all, diagnostics);
  return all;
}

const std::vector<Manifest>& manifests() {
  static const std::vector<Manifest> kAll = [] {
    Diagnostics diagnostics;
    std::vector<Manifest> all = readManifests(pluginFolders(), diagnostics);
    if (diagnostics.hasErrors()) throw InputError(std::move(diagnostics));
    return all;
  }();
  return kAll;
}

const Manifest::Element* findElement(const std::string& name) {
  for (const Manifest& manifest : manifests()) {
    const auto found = std::ranges::find(manifest.elements, name, &Manifest::Element::name);
    if (found != manifest.elements.end()) return &*found;
  }
  return nullptr;
}

std::string sceneSchemaWith(const std::vector<Manifest>& all) {
  std::string xsd = schemas::scene, types;
  std::map<Manifest::Place, std::string> declarations;
  for (const Manifest& manifest : all) {
    for (const Manifest::Element& element : manifest.elements)
      declarations[element.place] += declarationOf(element, types);
  }
  insertAt(xsd, "types of plug-ins", types);
  for (const auto& [place, text] : declarations)
    insertAt(xsd, std::string("elements of plug-ins: ") + nameOf(place), text);
  return xsd;
}

}  // namespace presa
