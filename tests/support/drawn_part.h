#pragma once
#include <memory>
#include <string>
#include <vector>

#include "framework/core/math/spatial.h"

namespace presa::test {

/// One part of the picture without a picture: the lines that it draws.
///
///     DrawnPart part("<trail length=\"1\"/>");
///     part.follow(0, {0, 0, 0});
///     EXPECT_EQ(part.follow(0.1, {0.01, 0, 0}).size(), 1U);
///
/// The element is read like any scene's, with the plug-in's manifest. The scene has a cube of 70 mm at W's origin and
/// one fingertip.
class DrawnPart {
 public:
  /// One Canvas::line.
  struct Line {
    Vec3 p_WA,  ///< one end [m]
        p_WB,   ///< other end [m]
        color;  ///< linear RGB, 0 to 1
  };

  /// Throws InputError with every finding.
  explicit DrawnPart(const std::string& element);
  ~DrawnPart();

  /// One tick of the view at `time` [s] with the fingertip at p_WT [m], and the lines that it then draws.
  std::vector<Line> follow(double time, const Vec3& p_WT, bool touching = false);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace presa::test
