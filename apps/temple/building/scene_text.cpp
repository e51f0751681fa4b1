#include "apps/temple/building/scene_text.h"

#include <array>
#include <cstdarg>
#include <cstdio>

#include "apps/temple/building/assembly_text.h"
#include "framework/geometry/obj_text.h"
#include "framework/scene/xml/escaped.h"

namespace presa::temple {
namespace {

[[gnu::format(printf, 1, 2)]] std::string format(const char* pattern, ...) {
  std::array<char, 512> text;
  va_list arguments;
  va_start(arguments, pattern);
  std::vsnprintf(text.data(), text.size(), pattern, arguments);
  va_end(arguments);
  return text.data();
}

std::string poseText(const Pose& X) {
  return format("pos=\"%.17g %.17g %.17g\" quat=\"%.17g %.17g %.17g %.17g\"", X.p.x(), X.p.y(), X.p.z(), X.q.w(),
                X.q.x(), X.q.y(), X.q.z());
}

std::string meshName(const Block& block, const char* role) { return "meshes/" + block.name + "_" + role + ".obj"; }

constexpr const char* kFigureMesh = "meshes/person.obj";

std::string partRole(std::size_t part) { return "physics" + std::to_string(part); }

std::string physicsText(const Block& block) {
  struct Text {
    const Block& block;
    Vec3 p_BG;
    std::string role;  // of a mesh
    std::string place() const {
      return p_BG.isZero() ? "" : format(" pos=\"%.9g %.9g %.9g\"", p_BG.x(), p_BG.y(), p_BG.z());
    }
    std::string operator()(const Box& box) const {
      return format("<box size=\"%.9g %.9g %.9g\"", box.size.x(), box.size.y(), box.size.z()) + place() + "/>";
    }
    std::string operator()(const Cylinder& rod) const {
      return format("<cylinder radius=\"%.9g\" length=\"%.9g\"", rod.radius, rod.length) + place() + "/>";
    }
    std::string operator()(const MeshRef&) const { return "<mesh file=\"" + meshName(block, role.c_str()) + "\"/>"; }
    std::string operator()(const Sphere&) const { return {}; }
    std::string operator()(const Capsule&) const { return {}; }
    std::string operator()(const Compound&) const { return {}; }
  };
  if (block.parts.empty()) return std::visit(Text{block, Vec3::Zero(), "physics"}, block.physics);
  std::string text;
  for (std::size_t i = 0; i < block.parts.size(); ++i) {
    const Block::Part& part = block.parts[i];
    text += std::visit(Text{block, part.p_BG, partRole(i)}, part.shape);
  }
  return text;
}

/// Paint changes nothing but the colour.
std::string marbleText(const std::string& name, const std::string& color) {
  return "    <material name=\"" + name + "\" stiffness=\"1000\" damping=\"1\" color=\"" + color +
         "\" texture=\"stone\"><friction static=\"0.7\" dynamic=\"0.6\" torsion=\"0.0025\"/></material>\n";
}

/// Triglyphs were blue, the ground of metopes red, that of the pediment blue [Brinkmann and Wünsche 2003].
const char* materialOf(BlockKind kind, bool painted) {
  if (!painted) return "marble";
  if (kind == BlockKind::kTriglyph || kind == BlockKind::kTympanum) return "painted_blue";
  return kind == BlockKind::kMetope ? "painted_red" : "marble";
}

std::string visualText(const Block& block) {
  if (!block.model) return "<visual><mesh file=\"" + meshName(block, "visual") + "\"/></visual>";
  const auto& [file, scale, p] = *block.model;
  return format("<visual pos=\"%.9g %.9g %.9g\"><mesh file=\"", p.x(), p.y(), p.z()) + xml::escaped(file) +
         format("\" scale=\"%.9g %.9g %.9g\"/></visual>", scale.x(), scale.y(), scale.z());
}

std::string bodyText(const Block& block, const SceneSpec::Stone& stone, const SceneSpec& spec) {
  const bool physics_only = spec.physics_only;
  std::string text = "  <body name=\"" + block.name + "\" material=\"" + materialOf(block.kind, spec.painted) + "\" " +
                     (stone.fixed ? "fixed=\"true\" " : "") + poseText(stone.X_WB) + ">\n";
  if (!physics_only) {
    text += "    " + visualText(block) + "\n";
    text += "    <haptic><mesh file=\"" + meshName(block, "haptic") + "\"/></haptic>\n";
  }
  text += stone.fixed ? "    <physics>" : format("    <physics mass=\"%.6g\">", block.mass);
  return text + physicsText(block) + "</physics>\n  </body>\n";
}

std::string footingText(const std::string& name, const char* material, const Pose& X_WB, const Vec3& size) {
  const std::string box = format("<box size=\"%.9g %.9g %.9g\"/>", size.x(), size.y(), size.z());
  return "  <body name=\"" + name + "\" fixed=\"true\" material=\"" + material + "\" " + poseText(X_WB) +
         ">\n    <haptic>" + box + "</haptic>\n    <physics>" + box + "</physics>\n  </body>\n";
}

}  // namespace

std::string sceneText(const Building& building, const SceneSpec& spec) {
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<scene version=\"1.0\" name=\"" + spec.name + "\"" +
                     (spec.rig.empty() ? "" : " rig=\"" + spec.rig + "\"") + " description=\"" + spec.description +
                     "\">\n  <world gravity=\"0 0 -9.81\"/>\n";
  // no haptics while stones fall: the haptic group only provides the time base
  if (spec.physics_only) text += "  <rates haptic=\"200\" collision=\"100\" dynamics=\"200\" view=\"50\"/>\n";
  if (spec.fine_steps) text += "  <dynamics substeps=\"10\" iterations=\"100\"/>\n";
  text += "  <materials>\n" + marbleText("marble", "0.68 0.60 0.47");
  if (spec.painted) text += marbleText("painted_blue", "0.06 0.13 0.36") + marbleText("painted_red", "0.46 0.07 0.04");
  text +=
      "    <material name=\"limestone\" stiffness=\"1000\" damping=\"1\" color=\"0.50 0.45 0.36\" texture=\"stone\">"
      "<friction static=\"0.7\" dynamic=\"0.6\"/></material>\n"
      "    <material name=\"earth\" stiffness=\"1000\" damping=\"1\" color=\"0.23 0.20 0.13\" texture=\"earth\">"
      "<friction static=\"0.8\" dynamic=\"0.7\"/></material>\n"
      "    <material name=\"cloth\" stiffness=\"1000\" color=\"0.50 0.24 0.15\">"
      "<friction static=\"0.5\" dynamic=\"0.4\"/></material>\n"
      "  </materials>\n";
  for (const SceneSpec::Stone& stone : spec.stones) text += bodyText(building.blocks[stone.block], stone, spec);
  constexpr double kThick = 0.04;
  text += footingText("ground", "earth", {{0, 0, -kThick / 2}, Quat::Identity()}, {2 * kGroundX, 2 * kGroundY, kThick});
  for (const Footing& step : building.footings) text += footingText(step.name, "limestone", step.X_WB, step.size);
  if (building.figure && !spec.physics_only)
    text += "  <body name=\"person\" fixed=\"true\" material=\"cloth\" " + poseText(building.figure->X_WB) +
            ">\n    <visual><mesh file=\"" + kFigureMesh + "\"/></visual>\n  </body>\n";
  if (!spec.rig.empty()) {
    text += "  <devices>\n";
    for (const char* role : {"thumb", "index"})
      text += format("    <device role=\"%s\" fingertip_radius=\"0.008\"/>\n", role);
    text += "  </devices>\n";
  }
  // the workspace is twice as high as the building and 0.5 m more: room to carry blocks
  if (spec.to_be_built)
    text += assemblyText(building, {1.9 * kGroundX, 1.9 * kGroundY, 2 * building.top + 0.5}, spec.words, spec.elapsed);
  return text + "</scene>\n";
}

SceneSpec assembled(const Building& building) {
  SceneSpec spec;
  spec.name = building.name;
  spec.description = "A Doric building, assembled";
  for (std::size_t i = 0; i < building.blocks.size(); ++i) spec.stones.push_back({i, building.blocks[i].X_WB, false});
  return spec;
}

std::vector<SceneFile> meshFiles(const Building& building, bool physics_only) {
  std::vector<SceneFile> files;
  for (const Block& block : building.blocks) {
    if (!physics_only) {
      if (!block.model) files.push_back({meshName(block, "visual"), objText(block.visual)});
      files.push_back({meshName(block, "haptic"), objText(block.haptic)});
    }
    if (!block.physics_mesh.triangles.empty())
      files.push_back({meshName(block, "physics"), objText(block.physics_mesh)});
    for (std::size_t i = 0; i < block.parts.size(); ++i) {
      if (block.parts[i].mesh.triangles.empty()) continue;
      files.push_back({meshName(block, partRole(i).c_str()), objText(block.parts[i].mesh)});
    }
  }
  if (building.figure && !physics_only) files.push_back({kFigureMesh, objText(building.figure->mesh)});
  return files;
}

}  // namespace presa::temple
