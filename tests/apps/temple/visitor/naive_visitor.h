#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/assembly/guide_module.h"
#include "framework/core/state/device_state.h"
#include "framework/scene/world.h"
#include "modules/view_osg/follow_camera.h"
#include "tests/apps/temple/visitor/mouse_hand.h"

namespace presa::temple::test {

/// What the visit's picture offers to somebody who has never seen it.
struct Cues {
  bool shown_how = false;   ///< an animated hand shows drag, pinch, lift and turn
  bool drop_lines = false;  ///< shadow and drop line of the fingertips: depth is seen, not guessed
};

/// A scripted visitor who has never seen the program, with a mouse. It is a model of what mouse users do and no
/// person: it has to find out drag, wheel, Shift and keys, guesses depth, overshoots, trembles, rests for seconds,
/// takes any block first, and in some of the visits ignores what it is shown. It sees the bodies, its own fingertips
/// and the words of the guide, and acts through MouseHand alone. Equal seeds act equally. Thread: view.
class NaiveVisitor final : public Module {
 public:
  /// `practised`: knows the controls and sees depth well.
  NaiveVisitor(std::shared_ptr<const World> world, std::uint64_t seed, const Cues& cues, bool practised);
  void step(const Tick& tick) noexcept override;
  std::vector<std::string> stages() const override { return {"look, decide, move the mouse"}; }

  std::optional<double> finishedAt() const { return finished_at_; }  ///< all blocks placed [s]
  int placed() const { return placed_; }
  /// Each decision with its time, for a failed test.
  const std::string& diary() const { return diary_; }

 private:
  enum class Aim { kLook, kOver, kDown, kPinch, kUp, kCarry, kTurn, kLower, kOpen, kAway };
  struct Known {
    double drag = 0, pinch = 0, lift = 0, turn = 0;  ///< from this time on [s]
  };
  void drawKnowledge(const Cues& cues);
  void look();
  void decide();
  void next(Aim aim);
  void chooseBlock();
  Vec3 fingers() const;
  double opening() const;
  Vec3 guess(const Vec3& p_W);
  const Pose& poseOf(std::size_t body) const { return objects_->bodies[body].X_WB_end; }
  bool isPlaced(std::size_t body) const;
  void over();
  void down();
  void pinch();
  void up();
  void carry();
  void turnIt();
  void lower();
  void open();
  void write(const std::string& what);

  In<ObjectState> objects_{*this, "object_state"};
  In<DeviceState> device_{*this, "device_state"};
  In<GuideState> guide_{*this, "guidance"};
  In<AssemblyState> assembly_{*this, "assembly_state"};
  Out<PointerState> pointer_out_{*this, kPointerPort};

  std::shared_ptr<const World> world_;
  RandomStream random_;
  view::PointerControl pointer_{{0, 1}};
  view::CameraControl camera_{16.0 / 9};
  view::FollowCamera follow_{PictureOptions{}, view::kEyeLevel};
  MouseHand hand_;
  Known known_;
  bool ignores_ = false, practised_ = false;
  double there_ = 0.014;  // nearer does not look better [m]
  double depth_ = 0;      // standard deviation of a guess along the line of sight [m]
  double now_ = 0, until_ = 0;
  Aim aim_ = Aim::kLook;
  std::optional<std::size_t> block_;
  std::vector<double> waits_;  // by body: not again before [s]
  double taken_z_ = 0;
  int tries_ = 0, placed_ = 0;
  std::optional<double> finished_at_;
  std::string diary_;
};

}  // namespace presa::temple::test
