#pragma once
#include <optional>
#include <osg/MatrixTransform>
#include <vector>

#include "framework/session/view.h"
#include "modules/view_osg/hud_widgets.h"
#include "modules/view_osg/ink.h"

namespace presa::view {

/// The menu of scenes in a window: all of them in columns, with a heading for each group, and the sentence of the marked
/// one below. Thread: view.
class SceneMenu {
 public:
  static constexpr std::size_t kColumns = 3;

  /// `center`: a group whose origin is the middle of the picture. The menu begins closed, with the scene `now` marked.
  SceneMenu(osg::Group& center, const Ink& ink, std::vector<OfferedScene> scenes, std::size_t now);

  bool open() const { return panel_->getNodeMask() != 0; }
  void toggle() { panel_->setNodeMask(~panel_->getNodeMask()); }
  /// Width over height of the picture: in a narrow one the menu is smaller.
  void setAspect(double aspect);
  /// A key (of osgGA) while the menu is open.
  void key(int key);
  std::size_t marked() const { return marked_; }
  /// What was chosen; the menu stays open.
  std::optional<SceneWish> wish() const { return wish_; }

 private:
  struct Cell {
    std::size_t column, row;
  };
  void layOut();
  bool fits(std::size_t rows);
  void draw();
  void mark(std::size_t scene);
  void step(int by);
  void sideways(int by);

  std::vector<OfferedScene> scenes_;
  std::vector<Cell> cells_, headings_;  // of each scene, and of each group at its first scene
  std::size_t rows_ = 0;                // of the longest column
  std::size_t marked_;
  std::optional<SceneWish> wish_;
  const Ink ink_;
  osg::ref_ptr<osg::MatrixTransform> panel_ = new osg::MatrixTransform, bar_ = new osg::MatrixTransform;
  std::optional<Label> sentence_;
  float line_ = 0;  // height of a row
};

}  // namespace presa::view
