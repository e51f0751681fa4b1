#include "modules/view_osg/view_module.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <osg/Notify>

#include "framework/core/diagnostics/refuse.h"
#include "framework/geometry/large_pages.h"
#include "framework/session/module_plugin.h"
#include "modules/view_osg/frame_image.h"

namespace presa::view {
namespace {

std::string timeStamp(double time) {
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%.3f", time);
  return text.data();
}

}  // namespace

ViewModule::ViewModule(std::shared_ptr<const World> world, const RunOptions& options)
    : View("view_osg", RateGroup::kView),
      world_(std::move(world)),
      options_(options),
      plugin_parts_(PluginParts::of(world_)) {
  // Mesa's software renderer would use all cores, including the haptic thread's, here or in the process whose run is
  // shown. Set before any thread starts.
  if (options_.realtime || windowed() || options_.bus) setenv("LP_NUM_THREADS", "1", 0);
  for (const Body& body : world_->scene.bodies) frame_.X_WB.push_back(body.X_WB);
  frame_.asleep.resize(frame_.X_WB.size());
  if (!world_->rig.frames.empty()) frames_.emplace(*this, kFramesPort, In<FrameState>::Optional{});
  if (world_->scene.hasTools()) tools_.emplace(*this, kToolStatesPort, In<ToolStates>::Optional{});
  if (!options_.video.empty()) video_.emplace(options_.video, options_.picture.video_rate);
  const ShownParts asked(options_.show);
  if (windowed() || asked[ShownPart::kPatches])
    neighbourhoods_.emplace(*this, "contact_patches", In<FingerNeighbourhoods>::Optional{});
  if (!options_.screenshot.empty()) screenshot_.outcome = Screenshot::Outcome::kPending;
}

ViewModule::~ViewModule() = default;

std::vector<std::string> ViewModule::stages() const {
  std::vector<std::string> all{"take the latest states, poses interpolated to now",
                               "handle keys and mouse, draw a frame"};
  if (!windowed())
    all = {"keep the latest state",
           options_.screenshots.empty() ? "draw the picture once, when it is due" : "draw the pictures that are due"};
  if (plugin_parts_) std::ranges::copy(plugin_parts_->what(), std::back_inserter(all));
  return all;
}

void ViewModule::start() {
  osg::setNotifyLevel(osg::FATAL);
  if (!windowed()) growHeapInLargePages(5);  // what a still of 1280 x 720 touches
  try {
    picture_ = std::make_unique<Picture>(world_, options_);
    if (plugin_parts_) picture_->space()->addChild(plugin_parts_->root());
    if (time_ != nullptr) picture_->timeBar().offer(*time_, length_, options_.picture.hud != PictureOptions::Hud::kOff);
    if (windowed() && !scenes_.empty()) picture_->hud().offerScenes(scenes_, scene_);
    renderer_ = makeRenderer();
    if (windowed() && canvas_ == nullptr && forVisitors(*world_)) drawRuins();
  } catch (const InputError&) {
    throw;  // a driver's figure
  } catch (const std::exception& error) {
    if (windowed())
      refuse(701, "command line", std::string("cannot show the run: ") + error.what(),
             "set DISPLAY to a running X server, or use the off-screen view");
    refuse(702, "command line", std::string("cannot draw off-screen: ") + error.what(),
           "install Mesa's EGL and software renderer (Debian: libegl1 libegl-mesa0 libgl1-mesa-dri)");
  }
}

std::unique_ptr<Renderer> ViewModule::makeRenderer() {
  const std::string title = "Presa: " + world_->scene.name;
  if (canvas_ != nullptr) return makeWallRenderer(*picture_, *canvas_, windowed(), title);
  if (!windowed()) {
    const Pictures some = options_.screenshots.empty() ? Pictures::kOne : Pictures::kSome;
    return makeOffscreenRenderer(*picture_, options_.picture, video_ ? Pictures::kFilm : some);
  }
  const bool nameless = options_.participant || forVisitors(*world_);
  return makeWindowRenderer(*picture_, nameless ? "Presa" : title,
                            {.pointer = pointer_ ? &*pointer_ : nullptr,
                             .frames = frame_keys_ ? &*frame_keys_ : nullptr,
                             .time = time_,
                             .undo = world_->scene.assembly.has_value(),
                             .menu = picture_->hud().menu(),
                             .participant = options_.participant.has_value(),
                             .visitor = forVisitors(*world_)},
                            options_.picture);
}

// The first picture of many stones takes a second, for their meshes, textures and shadows. It comes before the run, in
// whose first second the stones find their rest and the dynamics need a processor for themselves. Here the camera does
// not follow the fingers, which are not known yet.
void ViewModule::drawRuins() {
  frame_.guidance.emplace().all = static_cast<std::int32_t>(world_->scene.assembly->goals.size());
  follow();
  show();
  renderer_->render();
}

void ViewModule::follow() {
  picture_->follow(frame_, timings_);
  if (plugin_parts_) plugin_parts_->follow(frame_);
}

void ViewModule::step(const Tick& tick) noexcept {
  if (!renderer_ || broken_) return;
  try {
    copyPorts(tick);
    follow();
    if ((windowed() || canvas_ != nullptr) && (time_ == nullptr || !time_->skip_picture)) drawWindow();
    if (video_ && video_->due(frame_.time)) film();
    if (screenshotDue()) saveScreenshot();
    saveSeries();
  } catch (const std::exception& error) {
    giveUp(error.what());
  }
}

void ViewModule::stop() {
  if (renderer_ && screenshot_.outcome == Screenshot::Outcome::kPending) saveScreenshot();
  if (video_) video_trouble_ = video_->finish();
  if (renderer_ && windowed() && !broken_ && options_.participant) {
    setScreen(*options_.participant);
    refresh();
  }
  renderer_.reset();
  picture_.reset();
}

void ViewModule::setBanner(const std::string& text, bool alarm) {
  if (picture_) picture_->hud().setBanner(text, alarm);
}

void ViewModule::setScreen(const ParticipantScreen& screen) {
  if (picture_) picture_->setScreen(screen);
}

void ViewModule::offerPointer(const std::vector<std::size_t>& fingers) {
  if (!pointer_out_) pointer_out_.emplace(*this, kPointerPort);
  pointer_.emplace(fingers);
}

void ViewModule::offerFrames() {
  if (!pointer_out_) pointer_out_.emplace(*this, kPointerPort);
  frame_keys_.emplace();
}

void ViewModule::offerTime(TimeControl& time_control, double length) noexcept {
  time_ = &time_control, length_ = length;
}

std::optional<SceneWish> ViewModule::sceneWanted() const noexcept {
  const std::int64_t wish = wish_.load(std::memory_order_relaxed);
  if (wish < 0) return std::nullopt;
  return SceneWish{static_cast<std::size_t>(wish / 2), wish % 2 == 1};
}

void ViewModule::refresh() noexcept {
  if (!renderer_ || broken_ || !windowed()) return;
  try {
    drawWindow();
  } catch (const std::exception& error) {
    giveUp(error.what());
  }
}

void ViewModule::copyPorts(const Tick& tick) {
  frame_.time = tick.time;
  frame_.device = device_state_.value();
  frame_.contacts = contact_exchange_.value();
  frame_.forces = force_command_.value();
  if (neighbourhoods_ && neighbourhoods_->hasValue()) frame_.neighbourhoods = &neighbourhoods_->value();
  if (joint_positions_.connected()) frame_.joint_positions = &joint_positions_.value();
  if (tools_ && tools_->hasValue()) frame_.tools = &tools_->value();
  if (frames_ && frames_->hasValue()) frame_.frames = &frames_->value();
  if (guidance_.connected()) frame_.guidance = guidance_->now;
  if (!object_state_.hasValue()) return;
  const ObjectState& objects = object_state_.value();
  const std::size_t count = std::min(frame_.X_WB.size(), objects.bodies.size());
  for (std::size_t i = 0; i < count; ++i) {
    frame_.X_WB[i] = objects.poseAt(static_cast<std::int32_t>(i), tick.time);
    frame_.asleep[i] = objects.bodies[i].asleep;
  }
}

void ViewModule::show() {
  if (plugin_parts_) plugin_parts_->draw(frame_);
  picture_->show(frame_, timings_);
}

void ViewModule::drawWindow() {
  show();
  if (pointer_) {
    pointer_->begin(frame_.device);
    pointer_->heed(frame_.device);
  }
  renderer_->render();
  if (pointer_) pointer_out_->value = pointer_->state();
  if (frame_keys_) pointer_out_->value.frames = frame_keys_->wish();
  undos_.store(renderer_->inputs().undos, std::memory_order_relaxed);
  onwards_.store(renderer_->inputs().onwards, std::memory_order_relaxed);
  inputs_.store(renderer_->inputs().all, std::memory_order_relaxed);
  sharpness_.store(renderer_->sharpness(), std::memory_order_relaxed);
  const SceneMenu* const menu = picture_->hud().menu();
  const bool wished = menu != nullptr && menu->wish();
  if (wished)
    wish_.store(static_cast<std::int64_t>(2 * menu->wish()->scene) + (menu->wish()->by_hand ? 1 : 0),
                std::memory_order_relaxed);
  if (wished || renderer_->closed()) wants_stop_.store(true, std::memory_order_relaxed);  // also while time is paused
  if (!renderer_->takePictureRequest()) return;
  const std::string file = "presa-" + world_->scene.name + "-" + timeStamp(frame_.time) + "s.png";
  const std::string trouble = savePicture(file);
  picture_->hud().tell(!trouble.empty() ? trouble : forVisitors(*world_) ? "\xe2\x9c\x93" : "saved " + file);
}

bool ViewModule::screenshotDue() const {
  return screenshot_.outcome == Screenshot::Outcome::kPending && options_.screenshot_time >= 0 &&
         frame_.time >= options_.screenshot_time;
}

void ViewModule::saveScreenshot() {
  const std::string& file = options_.screenshot;
  const std::string trouble = savePicture(file);
  if (trouble.empty())
    screenshot_ = {Screenshot::Outcome::kWritten, "wrote " + file + ", t = " + timeStamp(frame_.time) + " s"};
  else
    screenshot_ = {Screenshot::Outcome::kFailed, "cannot write " + file + ": " + trouble};
}

void ViewModule::film() {
  show();
  if (const osg::ref_ptr<osg::Image> image = renderer_->capture()) video_->add(*image, frame_.time);
}

void ViewModule::saveSeries() {
  if (options_.screenshots.empty() || frame_.time < next_picture_) return;
  next_picture_ = frame_.time + options_.screenshot_every;
  std::array<char, 32> name;
  std::snprintf(name.data(), name.size(), "/%09.3f.png", frame_.time);
  const std::string trouble = savePicture(options_.screenshots + name.data());
  if (!trouble.empty()) throw std::runtime_error(trouble);
}

std::string ViewModule::savePicture(const std::string& file) {
  show();
  const osg::ref_ptr<osg::Image> image = renderer_->capture();
  return image ? writePng(*image, file) : "the window is closed";
}

void ViewModule::giveUp(const std::string& why) noexcept {
  broken_ = true;
  if (pointer_out_) pointer_out_->value.frames = {};  // no key is held any more
  if (screenshot_.outcome == Screenshot::Outcome::kPending) screenshot_ = {Screenshot::Outcome::kFailed, why};
}

namespace {

std::unique_ptr<Module> create(std::shared_ptr<const World> world, const RunOptions& options) {
  return std::make_unique<ViewModule>(std::move(world), options);
}

const ModulePlugin kPlugin{.name = "view_osg", .create = &create};

}  // namespace
}  // namespace presa::view

PRESA_MODULE_PLUGIN(presa::view::kPlugin)
