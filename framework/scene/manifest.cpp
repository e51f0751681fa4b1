#include "framework/scene/manifest.h"

#include <algorithm>
#include <filesystem>
#include <map>

#include "framework/plugin/plugin_loader.h"
#include "framework/scene/scene.h"
#include "framework/scene/scene_facts.h"
#include "framework/scene/schemas.h"
#include "framework/scene/xml/escaped.h"
#include "framework/scene/xml/listed.h"
#include "framework/scene/xml/schema.h"
#include "framework/scene/xml/value_rule.h"
#include "framework/scene/xml/xml.h"

namespace presa {
namespace {

namespace fs = std::filesystem;

enum ManifestCode { kNoManifest = 590, kBroken = 593, kTaken = 594, kAgainstKind = 595 };

constexpr const char* kPrefix = "presa_";

Manifest::Attribute readAttribute(const xml::Element& element) {
  return {element.attribute("name"),
          element.attribute("type"),
          element.attribute("unit"),
          element.attribute("about"),
          !element.hasAttribute("default"),
          element.attribute("default"),
          element.attribute("above"),
          element.attribute("min"),
          element.attribute("max"),
          element.attribute("finer"),
          xml::splitWords(element.attribute("tried"))};
}

using Place = Manifest::Place;

/// Kinds as they are called in manifests and in texts, and where their elements may stand.
struct KindRule {
  PluginKind kind;
  const char *word, *name;
  std::vector<Place> places;
};

const std::vector<KindRule>& kindRules() {
  static const std::vector<KindRule> kRules{
      {PluginKind::kForceEffect, "force_effect", "force effect", {Place::kBody, Place::kScene}},
      {PluginKind::kFrictionLaw, "friction_law", "friction law", {Place::kFriction}},
      {PluginKind::kRenderer, "renderer", "renderer", {Place::kHaptics}},
      {PluginKind::kToolRenderer, "tool_renderer", "tool renderer", {Place::kHaptics}},
      {PluginKind::kSurfaceEffect, "surface_effect", "surface effect", {Place::kBody, Place::kMaterial, Place::kScene}},
      {PluginKind::kModule, "module", "module", {Place::kBody, Place::kScene}},
      {PluginKind::kDevice, "device", "device", {}},
      {PluginKind::kMethod, "method", "method", {Place::kProcedure}},
      {PluginKind::kMetric, "metric", "metric", {}},
      {PluginKind::kBodyEffect, "body_effect", "body effect", {Place::kBody, Place::kScene}},
      {PluginKind::kViewPart, "view_part", "view part", {Place::kBody, Place::kScene}}};
  return kRules;
}

constexpr std::pair<Place, const char*> kPlaces[] = {{Place::kBody, "body"},         {Place::kScene, "scene"},
                                                     {Place::kMaterial, "material"}, {Place::kFriction, "friction"},
                                                     {Place::kHaptics, "haptics"},   {Place::kProcedure, "procedure"}};

const KindRule& ruleOf(PluginKind kind) { return *std::ranges::find(kindRules(), kind, &KindRule::kind); }

// The schema has checked the words.
PluginKind kindOf(const std::string& word) { return std::ranges::find(kindRules(), word, &KindRule::word)->kind; }
Place placeOf(const std::string& word) {
  return std::ranges::find(kPlaces, word, [](const auto& place) { return std::string(place.second); })->first;
}

// The schema has checked the word; a manifest without one is no module or is reported by checkRole.
RateGroup rateOf(const std::string& word) {
  for (int group = 0; group < kRateGroupCount; ++group)
    if (word == toString(static_cast<RateGroup>(group))) return static_cast<RateGroup>(group);
  return RateGroup::kHaptic;
}

Manifest::ModuleRole readRole(const xml::Element& root) {
  Manifest::ModuleRole role{.rate = rateOf(root.attribute("rate")), .engine = root.attribute("engine"), .wanted = {}};
  role.fingers = root.attribute("fingers") != "false";
  role.snap = root.attribute("snap") != "false";
  role.body_effects = root.attribute("body_effects") != "false";
  role.joints = root.attribute("joints") != "false";
  role.hits = root.attribute("hits") != "false";
  for (const xml::Element& wanted : root.children("wanted"))
    role.wanted.push_back(xml::splitWords(wanted.attribute("when")));
  return role;
}

Manifest read(const xml::Element& root, const std::string& file) {
  Manifest manifest{.name = root.attribute("name"),
                    .version = root.attribute("version"),
                    .kind = kindOf(root.attribute("kind")),
                    .about = root.attribute("about"),
                    .gives = root.attribute("gives"),
                    .needs_proxy = root.attribute("needs") == "proxy",
                    .needs_hits = root.attribute("needs") == "hits",
                    .left_out = root.attribute("left_out"),
                    .elements = {},
                    .settings = {},
                    .module = readRole(root),
                    .file = file};
  for (const xml::Element& child : root.children("element")) {
    Manifest::Element element{
        child.attribute("name"), placeOf(child.attribute("in")), {}, child.where(), child.attribute("quick") == "true"};
    for (const xml::Element& attribute : child.children("attribute"))
      element.attributes.push_back(readAttribute(attribute));
    manifest.elements.push_back(std::move(element));
  }
  for (const xml::Element& setting : root.children("setting")) manifest.settings.push_back(readAttribute(setting));
  return manifest;
}

void checkPlace(const Manifest& manifest, const Manifest::Element& element, Diagnostics& diagnostics) {
  const std::vector<Place>& places = ruleOf(manifest.kind).places;
  if (std::ranges::find(places, element.place) != places.end()) return;
  std::string allowed;
  for (const Place place : places)
    allowed += (allowed.empty() ? "in=\"" : " or in=\"") + std::string(nameOf(place)) + "\"";
  diagnostics.error(kAgainstKind, element.where,
                    "<" + element.name + "> of the " + nameOf(manifest.kind) + " '" + manifest.name +
                        "' cannot stand in=\"" + nameOf(element.place) + "\"",
                    allowed.empty() ? "it brings no elements; the keys of a device are <setting>" : allowed);
}

/// The scene must bound every force effect and body effect.
void checkBound(const Manifest& manifest, const Manifest::Element& element, Diagnostics& diagnostics) {
  const bool bounded = std::ranges::any_of(element.attributes, [](const Manifest::Attribute& attribute) {
    const bool bound = attribute.name == "max_force" || attribute.name == "max_torque";
    return bound && attribute.type == "number" && attribute.required;
  });
  if (bounded) return;
  diagnostics.error(kAgainstKind, element.where,
                    "<" + element.name + "> of the " + nameOf(manifest.kind) + " '" + manifest.name +
                        "' has no required number max_force or max_torque",
                    "the scene must bound every effect, one that gives a torque by max_torque; add <attribute "
                    "name=\"max_force\" type=\"number\" "
                    "unit=\"N\" above=\"0\" about=\"…\"/>");
}

/// Of fingertips or of tools: a scene names it by an attribute.
bool isRenderer(const Manifest& manifest) {
  return manifest.kind == PluginKind::kRenderer || manifest.kind == PluginKind::kToolRenderer;
}

/// A scene that names a renderer need not have its settings.
void checkSettings(const Manifest& manifest, const Manifest::Element& element, Diagnostics& diagnostics) {
  for (const Manifest::Attribute& attribute : element.attributes) {
    if (!attribute.required) continue;
    diagnostics.error(
        kAgainstKind, element.where,
        "<" + element.name + " " + attribute.name + "> of the renderer '" + manifest.name + "' has no default",
        "a scene may name a renderer without its settings; add default=\"…\"");
  }
}

/// Files are relative to the scene; an experiment has several folders.
void checkFiles(const Manifest& manifest, const Manifest::Element& element, Diagnostics& diagnostics) {
  for (const Manifest::Attribute& attribute : element.attributes) {
    if (attribute.type != "file") continue;
    diagnostics.error(kAgainstKind, element.where,
                      "<" + element.name + " " + attribute.name + "> of the method '" + manifest.name + "' is a file",
                      "only elements of scenes name files");
  }
}

/// A study of accuracy turns numbers only.
void checkFiner(const Manifest& manifest, const Manifest::Element& element, Diagnostics& diagnostics) {
  for (const Manifest::Attribute& attribute : element.attributes) {
    if (attribute.finer.empty() ? attribute.tried.empty() : attribute.type == "number") continue;
    diagnostics.error(
        kAgainstKind, element.where,
        "<" + element.name + " " + attribute.name + "> of the " + nameOf(manifest.kind) + " '" + manifest.name +
            "' has " + (attribute.finer.empty() ? "tried=\"…\" without finer=\"…\"" : "finer=\"…\", but is no number"),
        "finer=\"up\" or \"down\" says which numbers are more accurate, tried=\"…\" which ones a study tries");
  }
}

void checkElements(const Manifest& manifest, Diagnostics& diagnostics) {
  for (const Manifest::Element& element : manifest.elements) {
    checkPlace(manifest, element, diagnostics);
    checkFiner(manifest, element, diagnostics);
    if (manifest.kind == PluginKind::kForceEffect || manifest.kind == PluginKind::kBodyEffect)
      checkBound(manifest, element, diagnostics);
    if (isRenderer(manifest)) checkSettings(manifest, element, diagnostics);
    if (manifest.kind == PluginKind::kMethod) checkFiles(manifest, element, diagnostics);
  }
  if (isRenderer(manifest) && manifest.elements.size() > 1) {
    diagnostics.error(kAgainstKind, manifest.elements[1].where,
                      "the renderer '" + manifest.name + "' has a second element for its settings",
                      "put all attributes into <" + manifest.elements[0].name + ">");
  }
}

/// A rig sets what a device says; a device has no place in a scene, where it is one of several in a role.
void checkSettings(const Manifest& manifest, const xml::Element& root, Diagnostics& diagnostics) {
  if (manifest.kind == PluginKind::kDevice) return;
  for (const xml::Element& setting : root.children("setting"))
    diagnostics.error(kAgainstKind, setting.where(),
                      "the " + std::string(nameOf(manifest.kind)) + " '" + manifest.name + "' has <setting>",
                      "only a device does; other plug-ins have <element>");
}

/// What only modules say, and what every module has to say.
void checkRole(const Manifest& manifest, const xml::Element& root, Diagnostics& diagnostics) {
  const bool module = manifest.kind == PluginKind::kModule;
  const std::string who = "the " + std::string(nameOf(manifest.kind)) + " '" + manifest.name + "'";
  for (const char* word : {"rate", "engine", "fingers", "snap", "body_effects", "joints"}) {
    if (!module && root.hasAttribute(word))
      diagnostics.error(kAgainstKind, root.where(word), who + " says " + word + "=\"…\"", "only a module does");
  }
  for (const xml::Element& wanted : root.children("wanted")) {
    if (!module) diagnostics.error(kAgainstKind, wanted.where(), who + " has <wanted>", "only a module does");
    for (const std::string& word : xml::splitWords(wanted.attribute("when"))) {
      const std::vector<std::string>& names = factNames();
      if (std::ranges::find(names, word) != names.end()) continue;
      diagnostics.error(kAgainstKind, wanted.where("when"), "no fact " + quote(word) + didYouMean(word, names),
                        "facts: " + listed(names));
    }
  }
  if (module && !root.hasAttribute("rate"))
    diagnostics.error(kAgainstKind, root.where(), who + " has no rate", "rate=\"haptic\", \"collision\", …");
  if (module && manifest.module.wanted.empty() && manifest.elements.empty())
    diagnostics.error(kAgainstKind, root.where(), who + " is never needed",
                      "add <wanted when=\"…\"/>, or an <element> that calls for it");
}

/// `gives` says what others find the plug-in by.
void checkGift(const Manifest& manifest, const xml::Element& root, Diagnostics& diagnostics) {
  if (manifest.gives.empty()) return;
  const bool device = manifest.hasFigure() || manifest.gives == "hand";
  const PluginKind giver = manifest.hasProxy() ? PluginKind::kRenderer
                           : device            ? PluginKind::kDevice
                                               : PluginKind::kModule;
  if (manifest.kind == giver) return;
  diagnostics.error(
      kAgainstKind, root.where("gives"),
      "the " + std::string(nameOf(manifest.kind)) + " '" + manifest.name + "' says gives=\"" + manifest.gives + "\"",
      "only a " + std::string(nameOf(giver)) + " has a " + manifest.gives);
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
  checkGift(manifest, document->root(), diagnostics);
  checkRole(manifest, document->root(), diagnostics);
  checkSettings(manifest, document->root(), diagnostics);
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

std::string boundOf(const char* facet, const std::string& value) {
  return value.empty() ? "" : std::string("<xs:") + facet + " value=\"" + xml::escaped(value) + "\"/>";
}

/// XSD name of an attribute's type. A bounded number gets a type of its own, added to `types`.
std::string typeOf(const Manifest::Element& element, const Manifest::Attribute& attribute, std::string& types) {
  if (attribute.type == "vector3") return "vector3";
  if (attribute.type == "boolean") return "xs:boolean";
  if (attribute.type == "name" || attribute.type == "material") return "xs:NCName";
  if (attribute.type == "text") return "xs:string";
  if (attribute.type == "file") return attribute.required ? "path" : "xs:string";
  const std::string facets = boundOf("minExclusive", attribute.above) + boundOf("minInclusive", attribute.min) +
                             boundOf("maxInclusive", attribute.max);
  if (facets.empty()) return "xs:double";
  const std::string name = element.name + "." + attribute.name;
  types += "<xs:simpleType name=\"" + name + "\"><xs:restriction base=\"xs:double\">" + facets +
           "</xs:restriction></xs:simpleType>\n";
  return name;
}

/// Elements that their names tell apart may stand in a material several times.
bool hasName(const Manifest::Element& element) {
  return std::ranges::any_of(element.attributes, [](const Manifest::Attribute& attribute) {
    return attribute.name == "name" && attribute.required;
  });
}

std::string declarationOf(const Manifest::Element& element, std::string& types) {
  std::string out = "<xs:element name=\"" + element.name + "\" p:implied=\"false\"";
  if (element.place != Manifest::Place::kScene) out += " minOccurs=\"0\"";
  if (element.place == Manifest::Place::kMaterial && !hasName(element)) out += " p:occurs=\"0..1\"";
  out += "><xs:complexType>";
  for (const Manifest::Attribute& attribute : element.attributes) {
    out += "<xs:attribute name=\"" + attribute.name + "\" type=\"" + typeOf(element, attribute, types) + "\"";
    out += attribute.required ? " use=\"required\"" : " default=\"" + xml::escaped(attribute.default_value) + "\"";
    out += "><xs:annotation><xs:documentation>" + xml::escaped(attribute.about) +
           (attribute.unit.empty() ? "" : " [" + xml::escaped(attribute.unit) + "]") +
           "</xs:documentation></xs:annotation></xs:attribute>";
  }
  return out + "</xs:complexType></xs:element>\n";
}

std::string choice(const std::string& value) { return "<xs:enumeration value=\"" + value + "\"/>"; }

void insertAt(std::string& xsd, const std::string& mark, const std::string& text) {
  const std::size_t at = xsd.find("<!-- " + mark + " -->");
  if (at == std::string::npos) throw std::logic_error("the schema has no comment '" + mark + "'");
  xsd.insert(at, text);
}

}  // namespace

const char* nameOf(PluginKind kind) { return ruleOf(kind).name; }

const char* nameOf(Manifest::Place place) {
  return std::ranges::find(kPlaces, place, [](const auto& named) { return named.first; })->second;
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

const Manifest* findManifest(const std::string& name) {
  const auto found = std::ranges::find(manifests(), name, &Manifest::name);
  return found == manifests().end() ? nullptr : &*found;
}

std::vector<Manifest::Attribute> settingsOf(const DeviceBinding& binding) {
  const Manifest* driver = findManifest(binding.driver);
  if (driver == nullptr) return {};
  std::vector<Manifest::Attribute> all = driver->settings;
  const auto hand = std::ranges::find(driver->settings, "hand", &Manifest::Attribute::type);
  if (hand == driver->settings.end()) return all;
  const auto named = binding.settings.find(hand->name);
  const Manifest* worn_by = findManifest(named == binding.settings.end() ? hand->default_value : named->second.value);
  if (worn_by != nullptr) all.insert(all.end(), worn_by->settings.begin(), worn_by->settings.end());
  return all;
}

const Manifest& manifestGiving(const std::string& what) {
  const auto found = std::ranges::find(manifests(), what, &Manifest::gives);
  if (found != manifests().end()) return *found;
  Diagnostics diagnostics;
  diagnostics.error(kNoManifest, {}, "no plug-in gives a " + what,
                    "looked for manifests in " + listed(pluginFolders()));
  throw InputError(std::move(diagnostics));
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
    if (manifest.kind == PluginKind::kMethod) continue;  // of experiments
    for (const Manifest::Element& element : manifest.elements)
      declarations[element.place] += declarationOf(element, types);
  }
  insertAt(xsd, "types of plug-ins", types);
  std::string renderers, tool_renderers, engines;
  for (const Manifest& manifest : all) {
    if (manifest.kind == PluginKind::kRenderer) renderers += choice(manifest.name);
    if (manifest.kind == PluginKind::kToolRenderer) tool_renderers += choice(manifest.name);
    if (!manifest.module.engine.empty()) engines += choice(manifest.module.engine);
  }
  insertAt(xsd, "renderers of plug-ins", renderers);
  insertAt(xsd, "tool renderers of plug-ins", tool_renderers);
  insertAt(xsd, "engines of plug-ins", engines);
  for (const auto& [place, text] : declarations)
    insertAt(xsd, std::string("elements of plug-ins: ") + nameOf(place), text);
  return xsd;
}

std::string experimentSchemaWith(const std::string& xsd, const std::vector<Manifest>& all) {
  std::string declarations, types, whole = xsd;
  Diagnostics diagnostics;
  for (const Manifest& manifest : all) {
    if (manifest.kind != PluginKind::kMethod) continue;
    for (const Manifest::Element& element : manifest.elements) {
      declarations += declarationOf(element, types);
      if (xsd.find("<xs:element name=\"" + element.name + "\"") == std::string::npos) continue;
      diagnostics.error(
          kTaken, element.where,
          "plug-in '" + manifest.name + "' brings <" + element.name + ">, which is an element of experiments already",
          "rename the element, or remove the plug-in");
    }
  }
  if (diagnostics.hasErrors()) throw InputError(std::move(diagnostics));
  insertAt(whole, "types of plug-ins", types);
  insertAt(whole, "elements of plug-ins: procedure", declarations);
  return whole;
}

}  // namespace presa
