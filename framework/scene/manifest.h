#pragma once
#include <string>
#include <vector>

#include "framework/core/diagnostics/diagnostics.h"
#include "framework/core/schedule/tick.h"
#include "framework/scene/plugin_element.h"

namespace presa {

/// What a plug-in adds to scenes or experiments, from the file `presa_NAME.xml` beside its library `presa_NAME.so`.
/// Manifests are read without loading any library, so that a scene costs nothing for plug-ins that it does not name.
struct Manifest {
  /// Element in which an element of the plug-in stands: "in" of the manifest.
  enum class Place { kBody, kScene, kMaterial, kFriction, kHaptics, kProcedure };

  /// Type "file": in an element, a path relative to the scene; in a setting, to the rig.
  struct Attribute {
    std::string name,  ///< of the attribute or setting
        type,  ///< number, vector3, boolean, name, text, file or material (of the scene); of a setting also quaternion or hand
        unit,                   ///< SI unit such as "N m"; empty: none
        about;                  ///< meaning, one sentence
    bool required = true;       ///< it has no default
    std::string default_value;  ///< if not required
    std::string above,          ///< exclusive minimum of a number; empty: none
        min,                    ///< minimum of a number; empty: none
        max;                    ///< maximum of a number; empty: none
    std::string finer = {};  ///< "up", "down": a number whose larger, smaller values are more accurate; empty: neither
    std::vector<std::string> tried = {};  ///< where it has a direction: values for a study of accuracy, coarse to fine
  };
  /// An element that the plug-in adds to scenes or experiments.
  struct Element {
    std::string name;                   ///< unique among all plug-ins (E594)
    Place place = Place::kBody;         ///< where it may stand
    std::vector<Attribute> attributes;  ///< those that it may have
    SourceLocation where;               ///< in the manifest
    /// It changes the force much within a step of the dynamics, as ridges do: scenes that state no coupling then move
    /// what fingers hold at the haptic rate, where that can be done.
    bool quick = false;
  };

  /// When a run needs a module, and where it runs.
  struct ModuleRole {
    RateGroup rate = RateGroup::kHaptic;  ///< group in which the module steps
    /// One of several engines: scenes choose it by `<dynamics engine="…">`. Empty: no engine.
    std::string engine;
    bool fingers = true,      ///< the engine supports fingers
        snap = true,          ///< the engine supports snap constraints, which assemblies need
        body_effects = true,  ///< the engine supports body effects
        joints = true,        ///< the engine supports joints
        hits = true;          ///< the engine says which bodies hit each other
    /// Alternatives. Each lists the facts (framework/scene/scene_facts.h) that must hold together. Empty: the module is
    /// needed where one of its elements stands.
    std::vector<std::vector<std::string>> wanted;
  };

  std::string name,                            ///< of the plug-in: its library is presa_NAME.so
      version;                                 ///< of the plug-in, such as "1.0"
  PluginKind kind = PluginKind::kForceEffect;  ///< says which of the members below count
  std::string about;                           ///< what it does, one sentence
  /// "proxy": a renderer with a proxy; "hand": a driver whose hand may wear another device; "view", "bus": the module
  /// that draws, that publishes; "figure": a device whose driver says what it looks like
  /// (framework/device/device_figure.h); empty: nothing others ask for
  std::string gives;
  bool needs_proxy = false;  ///< a surface effect of renderers with a proxy: needs="proxy"
  bool needs_hits = false;   ///< it hears bodies that hit each other: needs="hits"
  std::string left_out;  ///< why a scene leaves it out, where its kind does not say; empty: derived from its elements
  std::vector<Element> elements;    ///< elements that it adds
  std::vector<Attribute> settings;  ///< of a device: keys that a rig may set
  ModuleRole module;                ///< of a module
  std::string file;                 ///< path of the manifest

  bool hasProxy() const { return gives == "proxy"; }    ///< a renderer whose proxy friction can hold
  bool hasFigure() const { return gives == "figure"; }  ///< a driver that says what its device looks like
};

/// Reads the manifests in the plug-in folders (pluginFolders). Of two with the same name the first folder's counts.
/// Errors: E593 a broken manifest or one whose name is not that of its file, E594 an element that Presa or another
/// plug-in brings already, E595 what a plug-in of its kind may not have or must have: the place of an element, the
/// required max_force or max_torque of a force or body effect, the defaults of a renderer's settings, the rate of a
/// module; a method that names a file; a direction of accuracy that is not a number's, or without values to try.
std::vector<Manifest> readManifests(const std::vector<std::string>& folders, Diagnostics& diagnostics);

/// The manifests of this process, read once. Throws InputError with all errors. Thread: any.
const std::vector<Manifest>& manifests();

/// The element of that name among the manifests of this process, or null; names are unique (E594). Thread: any.
const Manifest::Element* findElement(const std::string& name);

/// The manifest of that plug-in of this process, or null. Thread: any.
const Manifest* findManifest(const std::string& name);

/// The first manifest that gives this ("view", "bus"). Throws InputError E590 when no plug-in does. Thread: any.
const Manifest& manifestGiving(const std::string& what);

struct DeviceBinding;
/// The settings that a rig may give this device: those of its driver, and, where the driver has a setting of type
/// "hand", those of the driver whose hand it names. Empty for a driver without a manifest. Thread: any.
std::vector<Manifest::Attribute> settingsOf(const DeviceBinding& binding);

/// "force effect"
const char* nameOf(PluginKind kind);
/// "body": as in a manifest.
const char* nameOf(Manifest::Place place);

/// The schema of scenes with the elements of these plug-ins.
std::string sceneSchemaWith(const std::vector<Manifest>& all);

/// The schema of experiments with the elements of the methods among these plug-ins. Throws InputError: E594 when `xsd`
/// has an element of that name already.
std::string experimentSchemaWith(const std::string& xsd, const std::vector<Manifest>& all);

}  // namespace presa
