#pragma once
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "framework/scene/load.h"
#include "tests/support/edited.h"

/// A small scene, functions that edit it, and the place that an edit marks.
namespace presa::scene_test {

using test::edited;

inline const std::string kScene = R"(<?xml version="1.0" encoding="UTF-8"?>
<!-- Größe: characters of two bytes before a tag on the same line --> <scene version="1.0" name="test"
       description="two bodies, two fingers">
  <world gravity="0 0 -9.81"/>
  <rates haptic="1000" collision="100" dynamics="200" view="60"/>
  <materials>
    <material name="rubber" stiffness="1000" damping="1" color="0.75 0.25 0.2"><friction static="0.8" dynamic="0.6"/></material>
    <material name="wood" stiffness="2000"/>
  </materials>
  <body name="table" fixed="true" material="wood" pos="0 0 -0.02">
    <haptic><box size="0.6 0.4 0.04"/></haptic>
    <physics><box size="0.6 0.4 0.04"/></physics>
  </body>
  <body name="cube" material="rubber" pos="0 0 0.035" euler_deg="0 0 90">
    <visual><mesh file="meshes/cube.obj" scale="0.001 0.001 0.001"/></visual>
    <haptic><sphere radius="0.035"/></haptic>
    <physics mass="0.2"><cylinder radius="0.03" length="0.07"/></physics>
  </body>
  <devices>
    <device role="thumb" fingertip_radius="0.008"><limits force="10" force_rate="1000" watchdog_ms="20"/></device>
    <device role="index"/>
  </devices>
</scene>
)";

/// A text with one '@' as a mark. Line and column are counted here, independently of the reader.
struct Marked {
  std::string text;
  int line = 0;
  int column = 0;
};
inline Marked marked(const std::string& with_mark) {
  const auto at = with_mark.find('@');
  EXPECT_NE(at, std::string::npos);
  Marked result{with_mark, 1, 1};
  result.text.erase(at, 1);
  for (std::size_t i = 0; i < at; ++i) {
    const bool continues_character = (with_mark[i] & 0xC0) == 0x80;
    if (with_mark[i] == '\n') {
      ++result.line;
      result.column = 1;
    } else if (!continues_character) {
      ++result.column;
    }
  }
  return result;
}

inline Diagnostics findingsOf(const std::string& scene, const std::vector<Override>& overrides = {}) {
  Diagnostics diagnostics;
  parseScene(scene, "scene.xml", "/lab", overrides, diagnostics);
  return diagnostics;
}

}  // namespace presa::scene_test
