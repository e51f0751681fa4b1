// The page of a recording (`presa replay FILE --page`): what a browser draws and says at a time is compared with the
// recording, read by another reader.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "apps/common/file_text.h"
#include "apps/presa/replay_page/packed.h"
#include "apps/presa/replay_page/replay_page.h"
#include "apps/presa/replay_page/signals.h"
#include "framework/record/record_plugin.h"
#include "tests/apps/support/support.h"

namespace presa {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

constexpr std::uintmax_t kMaxPage = 5'000'000;  // bytes

std::string recorded(const std::string& scene, double duration = 0) {
  RunOptions options;
  options.record = test::scratch("replay_page.h5");
  options.overwrite = true;
  if (duration > 0) options.duration = duration;
  test::runScene(scene, {}, options, 0);
  return options.record;
}

std::string pageOf(const std::string& recording) {
  const std::string page = test::scratch("replay_page.html");
  const test::Outcome outcome = test::presa("replay " + recording + " --page " + page);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_LE(std::filesystem::file_size(page), kMaxPage);
  return contentsOf(page);
}

/// What a browser gives for the expression `probe` once the page is shown, and what it complains of.
struct Seen {
  json value;
  std::string complaints;
};
Seen seen(const std::string& page, const std::string& probe, const std::string& fragment = {},
          const std::string& flags = "--use-angle=swiftshader --enable-unsafe-swiftshader") {
  const std::string file = test::scratch("probed.html");
  std::ofstream(file) << page
                      << "<script>addEventListener('load', () => { const hex = text => Array.from(new TextEncoder()"
                         ".encode(text), byte => byte.toString(16).padStart(2, '0')).join('');"
                         "document.body.dataset.probe = hex(JSON.stringify("
                      << probe << ")); });</script>";
  const test::Outcome outcome = test::shell(
      "timeout 100 chromium --headless --no-sandbox --disable-dev-shm-usage --disable-quic --no-first-run "
      "--disable-background-networking --disable-component-update --disable-sync --enable-logging=stderr "
      "--window-size=1400,1000 --virtual-time-budget=2000 --user-data-dir=" +
      test::scratch("profile") + " " + flags + " --dump-dom 'file://" + file + fragment + "'");
  Seen result;
  for (std::size_t at = 0; (at = outcome.err.find("CONSOLE", at)) != std::string::npos; ++at)
    result.complaints += outcome.err.substr(at, outcome.err.find('\n', at) - at) + "\n";
  const std::string mark = "data-probe=\"";
  const std::size_t begin = outcome.out.find(mark);
  if (begin == std::string::npos) {
    ADD_FAILURE() << "the page did not answer: " << outcome.err;
    return result;
  }
  std::string text;
  for (std::size_t i = begin + mark.size(); outcome.out[i] != '"'; i += 2)
    text += static_cast<char>(std::stoi(outcome.out.substr(i, 2), nullptr, 16));
  result.value = json::parse(text);
  return result;
}

/// Moves the scrubber as a user does and says what is shown: times and figures as texts, poses, and the colour of the
/// picture at a point of the world.
constexpr const char* kLook = R"JS((() => {
  const {scene} = presaReplay, input = document.getElementById('replay-scrubber');
  const text = query => document.querySelector(query).textContent;
  const colorAt = point => {
    scene.draw();
    const p = new THREE.Vector3(...point).project(scene.camera), copy = document.createElement('canvas');
    copy.width = copy.height = 1;
    const pen = copy.getContext('2d');
    pen.drawImage(scene.canvas, (p.x + 1) / 2 * scene.canvas.width, (1 - p.y) / 2 * scene.canvas.height, 1, 1, 0, 0, 1, 1);
    return [...pen.getImageData(0, 0, 1, 1).data].slice(0, 3);
  };
  const look = time => {
    input.value = time;
    input.dispatchEvent(new Event('input'));
    scene.draw();
    const matrix = new THREE.Matrix4().multiplyMatrices(scene.camera.projectionMatrix, scene.camera.matrixWorldInverse);
    return {clock: text('[data-now=clock]'), phase: text('[data-now=phase]'), spoken: input.getAttribute('aria-valuetext'),
      normal: text('[data-title^="Normal"] [data-name=thumb]'), height: text('[data-title^="Height"] .value'),
      thumb: text('[data-title=Contact] [data-name=thumb]'), position: scene.positionOf('amphora'),
      screen: scene.screenOf('amphora'), view: [scene.canvas.clientWidth, scene.canvas.clientHeight], matrix: matrix.elements,
      low: colorAt([0, 0, 0.02]), high: colorAt([0, 0, 0.19])};
  };
  return {looks: [0, 2.4, 5, 8.53].map(look), requests: performance.getEntriesByType('resource').length,
    label: input.getAttribute('aria-label'), stops: input.tabIndex};
})())JS";

/// A recording and what is in it at a time.
class Truth {
 public:
  explicit Truth(const std::string& file) : samples_(recordPlugin().samples(file)) {}
  double at(const RecordedTable& table, const std::string& column, double time) const {
    return table.values(column)[static_cast<std::size_t>(std::lround(time / samples_.haptic_period))];
  }
  Vec3 body(double time) const {
    const RecordedTable& table = samples_.bodies.front();
    return {at(table, "p_WB_x", time), at(table, "p_WB_y", time), at(table, "p_WB_z", time)};
  }
  const RecordedTable& thumb() const { return samples_.fingers.front(); }

 private:
  RecordedSamples samples_;
};

/// Blue over red: terracotta 0.14/0.62 in linear light is 0.51 with gamma 2.2, wood 0.3/0.55 is 0.76, the grey
/// background about 1.
double tint(const json& color) { return color[2].get<double>() / color[0].get<double>(); }

// Tolerances: positions are levels of 65 534 over 0.1 m, so half a level is 0.8 um; figures are rounded for the eye;
// the projection is exact but for single precision.
TEST(ReplayPage, TheScrubberMovesThePictureAndTheFigures) {
  if (test::browserMissing()) GTEST_SKIP() << "no chromium here";
  const std::string recording = recorded("config/scenes/pinch_and_lift.xml");
  const Truth truth(recording);
  const Seen seen_page = seen(pageOf(recording), kLook);
  EXPECT_EQ(seen_page.complaints, "");
  EXPECT_EQ(seen_page.value["requests"], 0);
  EXPECT_EQ(seen_page.value["label"], "Time of the recording");
  EXPECT_EQ(seen_page.value["stops"], 0);
  const std::map<double, std::pair<std::string, std::string>> expected{
      {0, {"reach", "free"}}, {2.4, {"lift", "stick"}}, {5, {"hold", "stick"}}, {8.53, {"loosen", "slip"}}};
  std::size_t i = 0;
  for (const auto& [time, words] : expected) {
    const json& look = seen_page.value["looks"][i++];
    SCOPED_TRACE(look.dump());
    EXPECT_EQ(std::stod(look["clock"].get<std::string>()), time);
    EXPECT_EQ(look["phase"], words.first);
    EXPECT_THAT(look["spoken"].get<std::string>(), HasSubstr(words.first));
    EXPECT_EQ(look["thumb"], words.second);
    EXPECT_NEAR(std::stod(look["normal"].get<std::string>()), truth.at(truth.thumb(), "normal_force", time), 0.0051);
    EXPECT_NEAR(std::stod(look["height"].get<std::string>()), 1000 * truth.body(time).z(), 0.051);
    const Vec3 p_WB = truth.body(time);
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(look["position"][axis].get<double>(), p_WB[axis], 1e-6);
    Eigen::Matrix4d camera;
    for (int k = 0; k < 16; ++k) camera(k % 4, k / 4) = look["matrix"][k];
    const Eigen::Vector4d clip = camera * p_WB.homogeneous();
    EXPECT_NEAR(look["screen"][0].get<double>(), (clip.x() / clip.w() + 1) / 2 * look["view"][0].get<double>(), 0.1);
    EXPECT_NEAR(look["screen"][1].get<double>(), (1 - clip.y() / clip.w()) / 2 * look["view"][1].get<double>(), 0.1);
  }
  // the foot stands on the table and is lifted off it; then the neck is where only the background was
  const json &lying = seen_page.value["looks"][0], &held = seen_page.value["looks"][2];
  EXPECT_LT(tint(lying["low"]), 0.62);
  EXPECT_GT(tint(held["low"]), 0.68);
  EXPECT_GT(tint(lying["high"]), 0.9);
  EXPECT_LT(tint(held["high"]), 0.62);
}

TEST(ReplayPage, MouseKeysAndAddressSetTimeAndZoom) {
  if (test::browserMissing()) GTEST_SKIP() << "no chromium here";
  const Seen used = seen(pageOf(recorded("config/scenes/cube.xml")), R"JS((() => {
    const {clock, paper} = presaReplay, area = paper.plots, left = area.getBoundingClientRect().left;
    const key = (key, more) => dispatchEvent(new KeyboardEvent('keydown', {key, ...more}));
    const mouse = (type, x, more) => area.dispatchEvent(new PointerEvent(type, {clientX: left + x, pointerType: 'mouse', pointerId: 1, ...more}));
    area.setPointerCapture = () => {};  // no real pointer is down
    const out = {opened: [clock.time, clock.from, clock.to]};
    key('0'); out.all = [clock.from, clock.to];
    key('ArrowRight'); out.step = clock.time;
    key('ArrowLeft', {shiftKey: true}); out.back = clock.time;
    key(']'); out.phase = document.querySelector('[data-now=phase]').textContent;
    key(' '); out.playing = clock.playing; key(' '); out.paused = !clock.playing;
    const set = clock.time, under = paper.timeOf(300);
    mouse('pointermove', 300); out.peeked = Math.abs(clock.shown - under); out.kept = clock.time === set;
    mouse('pointerleave', 300); out.restored = clock.shown === set;
    mouse('pointerdown', 300); mouse('pointermove', 350); out.dragged = Math.abs(clock.time - paper.timeOf(350));
    mouse('pointerup', 350);
    area.dispatchEvent(new WheelEvent('wheel', {deltaY: -200, clientX: left + 300, cancelable: true}));
    out.span = (clock.to - clock.from) / presaReplay.length; out.fixed = Math.abs(paper.timeOf(300) - under);
    area.dispatchEvent(new MouseEvent('dblclick')); out.reset = clock.to - clock.from === presaReplay.length;
    return out;
  })())JS",
                         "#t=1.5&zoom=1,2");
  EXPECT_EQ(used.complaints, "");
  const json& out = used.value;
  SCOPED_TRACE(out.dump());
  EXPECT_EQ(out["opened"], json({1.5, 1.0, 2.0}));
  EXPECT_EQ(out["all"][0], 0.0);
  EXPECT_NEAR(out["all"][1].get<double>(), 9.999, 1e-9);
  EXPECT_NEAR(out["step"].get<double>(), 1.51, 1e-9);
  EXPECT_NEAR(out["back"].get<double>(), 1.41, 1e-9);
  EXPECT_EQ(out["phase"], "lift");  // config/motions/pinch_cube.xml
  for (const char* yes : {"playing", "paused", "kept", "restored", "reset"}) EXPECT_TRUE(out[yes].get<bool>()) << yes;
  for (const char* zero : {"peeked", "dragged"}) EXPECT_NEAR(out[zero].get<double>(), 0, 1e-9) << zero;
  EXPECT_NEAR(out["fixed"].get<double>(), 0, 0.006);  // browsers give the wheel's place in whole pixels, of 15 ms here
  EXPECT_NEAR(out["span"].get<double>(), std::exp(-0.4), 1e-9);
}

// Two seconds of frames at 50 Hz and half speed: one second of the recording. Whoever wants little motion sees at most
// four pictures a second, so eight; there, up to 0.25 s of the two have not been shown yet.
TEST(ReplayPage, PlaysAtTheChosenSpeedWithFewPicturesWhereMotionIsUnwanted) {
  if (test::browserMissing()) GTEST_SKIP() << "no chromium here";
  const std::string page = pageOf(recorded("config/scenes/cube.xml"));
  const std::string play = R"JS((() => {
    let pictures = 0, frames = [];
    requestAnimationFrame = draw => frames.push(draw);
    presaReplay.listen(what => { if (what === 'time') ++pictures; });
    document.querySelector('.replay-speed select').value = '0.5';
    dispatchEvent(new KeyboardEvent('keydown', {key: ' '}));
    for (let frame = 0; frame <= 100; ++frame) for (const draw of frames.splice(0)) draw(1000 + 20 * frame);
    return [presaReplay.clock.time, pictures];
  })())JS";
  const std::string flat = "--disable-3d-apis";  // time alone counts here, and 3-D frames are slow in software
  const Seen smooth = seen(page, play, "", flat),
             still = seen(page, play, "", flat + " --force-prefers-reduced-motion");
  EXPECT_EQ(smooth.complaints + still.complaints, "");
  EXPECT_NEAR(smooth.value[0].get<double>(), 1, 1e-9);
  EXPECT_GE(smooth.value[1].get<int>(), 100);
  EXPECT_NEAR(still.value[0].get<double>(), 1, 0.125);
  EXPECT_LE(still.value[1].get<int>(), 9);
  EXPECT_GE(still.value[1].get<int>(), 6);
}

TEST(ReplayPage, WithoutWebGLOrScriptsThePlotsAndASentenceRemain) {
  if (test::browserMissing()) GTEST_SKIP() << "no chromium here";
  const std::string page = pageOf(recorded("config/scenes/cube.xml"));
  const Seen flat = seen(page,
                         "[document.querySelector('.replay-trouble').textContent, "
                         "document.querySelector('[data-title^=Normal] canvas').width, !!presaReplay.scene, "
                         "document.querySelectorAll('.plot svg').length]",
                         "", "--disable-3d-apis");
  EXPECT_EQ(flat.complaints, "");
  EXPECT_THAT(flat.value[0].get<std::string>(), HasSubstr("no WebGL"));
  EXPECT_GT(flat.value[1].get<int>(), 300);
  EXPECT_FALSE(flat.value[2].get<bool>());
  EXPECT_EQ(flat.value[3], 2);
  EXPECT_TRUE(page.find("<noscript>") != std::string::npos);  // and the part that needs scripts stays hidden
  EXPECT_TRUE(page.find("aria-label=\"Motion and plots under one time\" hidden>") != std::string::npos);
}

// The meshes of a recording from elsewhere may not be here.
TEST(ReplayPage, WithoutTheSceneThePlotsRemainAndSayWhy) {
  if (test::browserMissing()) GTEST_SKIP() << "no chromium here";
  const std::string file = recorded("config/scenes/pinch_and_lift.xml", 1);
  Recording recording = recordPlugin().read(file);
  for (std::size_t at = 0; (at = recording.scene_xml.find("amphora.obj", at)) != std::string::npos; ++at)
    recording.scene_xml.replace(at, 7, "missing");
  const Seen flat = seen(replay_page::page(recording, recordPlugin().samples(file), ""),
                         "[document.querySelector('.replay-trouble').textContent, "
                         "document.querySelector('[data-title^=Normal] [data-name=thumb]').textContent]");
  EXPECT_EQ(flat.complaints, "");
  EXPECT_THAT(flat.value[0].get<std::string>(), HasSubstr("missing.obj"));
  EXPECT_EQ(flat.value[1], "0.00 N");
}

TEST(ReplayPage, NoFingersIsHeightsAlone) {
  if (test::browserMissing()) GTEST_SKIP() << "no chromium here";
  const Seen falling = seen(pageOf(recorded("config/scenes/sinking.xml", 1)),
                            "[[...document.querySelectorAll('.replay-panel[data-title]')].map(p => p.dataset.title), "
                            "presaReplay.scene.positionOf('in_air')]",
                            "#t=0.5");
  EXPECT_EQ(falling.complaints, "");
  EXPECT_EQ(falling.value[0], json({"Height [mm]"}));
  const RecordedSamples samples = recordPlugin().samples(test::scratch("replay_page.h5"));
  EXPECT_NEAR(falling.value[1][2].get<double>(), samples.bodies.front().values("p_WB_z")[500],
              1e-4);  // 5 m: 76 um a level
}

// A device that jumps away: marked in the plots, and the keys [ and ] go there.
TEST(ReplayPage, AFaultIsMarked) {
  if (test::browserMissing()) GTEST_SKIP() << "no chromium here";
  const std::string folder = test::scratch("jump");
  std::filesystem::create_directories(folder);
  std::ofstream(folder + "/jump.csv")
      << "time_s,role,x_m,y_m,z_m\n0,thumb,-0.1,0,0.03\n0,index,0.1,0,0.03\n"
         "0.5,thumb,-0.1,0,0.03\n0.502,thumb,1.5,0,0.03\n2,thumb,1.5,0,0.03\n2,index,0.1,0,0.03\n";
  std::ofstream(folder + "/rig.xml")
      << "<rig version=\"1.0\" name=\"jump\">"
         "<device role=\"thumb\" driver=\"scripted\"><set key=\"motion\" value=\"jump.csv\"/></device>"
         "<device role=\"index\" driver=\"scripted\"><set key=\"motion\" value=\"jump.csv\"/></device></rig>";
  const std::string recording = folder + "/run.h5";
  test::presa("run " + test::source("config/scenes/cube.xml") + " --rig " + folder +
              "/rig.xml --lockstep --view none --quiet --for 1 --record " + recording);
  const Seen jumped = seen(pageOf(recording),
                           "[presaReplay.data.faults, (dispatchEvent(new KeyboardEvent('keydown', {key: ']'})), "
                           "presaReplay.clock.time)]",
                           "#t=0.1");
  EXPECT_EQ(jumped.complaints, "");
  ASSERT_GE(jumped.value[0].size(), 1u);
  EXPECT_THAT(jumped.value[0][0]["text"].get<std::string>(), HasSubstr("thumb: device disconnected"));
  EXPECT_NEAR(jumped.value[0][0]["time"].get<double>(), 0.502, 0.003);
  EXPECT_EQ(jumped.value[1], jumped.value[0][0]["time"]);
  std::filesystem::remove_all(folder);
}

// Names come from the recording; those of the rig's files stand in for a recording of before.
TEST(ReplayPage, NamesThePhasesAsTheRecordingDoes) {
  RecordedSamples samples = recordPlugin().samples(recorded("config/scenes/cube.xml"));
  const auto first = [&] { return replay_page::phasesOf(samples, {"of the rig"})[0]["name"].get<std::string>(); };
  EXPECT_EQ(first(), "reach");  // config/motions/pinch_cube.xml
  for (RecordedTable& finger : samples.fingers) finger.phases.clear();
  EXPECT_EQ(first(), "of the rig");
}

// Eight fingers, as the two of the cube four times over.
TEST(ReplayPage, EightFingersStayWithinTheBudget) {
  const std::string file = recorded("config/scenes/cube.xml");
  const Recording recording = recordPlugin().read(file);
  RecordedSamples samples = recordPlugin().samples(file);
  for (int copy = 0; copy < 6; ++copy) samples.fingers.push_back(samples.fingers[static_cast<std::size_t>(copy)]);
  EXPECT_LE(replay_page::page(recording, samples, "").size(), kMaxPage - 1'000'000);  // room for three.js
}

// Ten minutes, as the ten seconds of the cube 60 times over, at a quarter of the rate (the budget knows rows alone).
TEST(ReplayPage, TenMinutesStayWithinTheBudget) {
  const std::string file = recorded("config/scenes/cube.xml");
  const Recording recording = recordPlugin().read(file);
  RecordedSamples samples = recordPlugin().samples(file);
  constexpr std::size_t kStride = 4, kRows = 150'000;
  const auto repeat = [&](auto& values) {
    const auto once = values;
    values.resize(kRows);
    for (std::size_t i = 0; i < kRows; ++i) values[i] = once[i * kStride % once.size()];
  };
  for (auto* tables : {&samples.fingers, &samples.bodies, &samples.tools})
    for (RecordedTable& table : *tables)
      for (RecordedTable::Column& column : table.columns) repeat(column.values);
  repeat(samples.status);
  samples.haptic_period *= kStride;
  samples.time.resize(kRows);
  for (std::size_t i = 0; i < kRows; ++i) samples.time[i] = static_cast<double>(i) * samples.haptic_period;
  const std::string page = replay_page::page(recording, samples, "");
  EXPECT_LE(page.size(), kMaxPage - 1'000'000);  // room for three.js
  const std::size_t note = page.find("\"decimation\":");
  const std::string said = page.substr(note, page.find('}', note) - note).substr(0, 300);
  EXPECT_THAT(said, HasSubstr("Plots: min and max of every "));
  EXPECT_THAT(said, HasSubstr("Picture: a pose every 204 ms (4.9 Hz)"));  // 3000 keyframes, each at a tick
}

std::vector<double> unpacked(const json& channel) {
  static const std::string kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t group = 0;
  int bits = 0;
  for (const char c : channel["d"].get<std::string>()) {
    if (c == '=') break;
    group = group << 6U | static_cast<std::uint32_t>(kDigits.find(c));
    if ((bits += 6) >= 8) bytes += static_cast<char>(group >> (bits -= 8) & 0xFFU);
  }
  std::vector<double> values;
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
    const int level =
        static_cast<std::int16_t>(static_cast<std::uint8_t>(bytes[i]) | static_cast<std::uint8_t>(bytes[i + 1]) << 8);
    values.push_back(level == -32768 ? NAN
                                     : channel["lo"].get<double>() + channel["step"].get<double>() * (level + 32767));
  }
  return values;
}

// 80 Hz of amplitude 1 in bins of 25 ms: two periods a bin, 12.5 samples a period, so a sample lies within 14.4 degrees
// of each crest: cos 14.4 = 0.968. A picked sample a bin would show a slow beat instead.
// A device without a figure adds nothing, and its switch stays hidden.
TEST(ReplayPage, WithoutFiguresNoDeviceIsInIt) {
  const std::string page = pageOf(recorded("config/scenes/pinch_and_lift.xml"));
  EXPECT_NE(page.find("\"parts\":[]"), std::string::npos);
  EXPECT_NE(page.find("<label hidden><input type=\"checkbox\" data-show=\"devices\""), std::string::npos);
}

TEST(ReplayPage, AnOscillationFasterThanTheBinsKeepsItsAmplitude) {
  std::vector<double> time, force;
  for (int i = 0; i < 100'000; ++i) {
    time.push_back(i * 1e-3);
    force.push_back(3 + std::cos(2 * M_PI * 80.3 * time.back()));
  }
  const replay_page::Bins bins = replay_page::binsOf(time, 1e-3, 4000);
  EXPECT_EQ(bins.count, 4000u);
  EXPECT_FALSE(bins.every_tick);
  const json packed = replay_page::envelope(time, force, bins);
  const std::vector<double> low = unpacked(packed["low"]), high = unpacked(packed["high"]);
  ASSERT_EQ(low.size(), bins.count);
  for (std::size_t i = 0; i < bins.count; ++i) {
    EXPECT_LT(low[i], 3 - 0.968);
    EXPECT_GT(high[i], 3 + 0.968);
  }
}

// Half a level of 65 534; gaps stay gaps; equal values need no data.
TEST(ReplayPage, PackedNumbersKeepFourDigits) {
  const std::vector<double> values{-2, NAN, 0.123456, 5, 4.9999};
  const std::vector<double> read = unpacked(replay_page::packed(values));
  ASSERT_EQ(read.size(), values.size());
  EXPECT_TRUE(std::isnan(read[1]));
  for (const std::size_t i : {0u, 2u, 3u, 4u}) EXPECT_NEAR(read[i], values[i], 0.5 * 7 / 65534 * 1.0001);
  EXPECT_EQ(replay_page::packed({2.5, 2.5}), json({{"lo", 2.5}}));
}

// Before the recording is read: this one does not even exist.
TEST(ReplayPage, APlaceThatTakesNoFileIsRefusedFirst) {
  const test::Outcome outcome = test::presa("replay nowhere.h5 --page /proc/nowhere/page.html");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("error[E126]"));
  EXPECT_THAT(outcome.err, Not(HasSubstr("E603")));
}

TEST(ReplayPage, AMissingLibraryIsNamedWithItsPackage) {
  const test::Outcome outcome = test::shell(
      "XDG_DATA_DIRS=/nowhere " PRESA_BINARY_DIR "/bin/presa replay nowhere.h5 --page " + test::scratch("page.html"));
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("error[E127]"));
  EXPECT_THAT(outcome.err, HasSubstr("libjs-three"));
}

// Nothing that a recording holds may become markup.
TEST(ReplayPage, NamesInTheDataBlockAreNoMarkup) {
  const std::string file = recorded("config/scenes/cube.xml", 0.5);
  const Recording recording = recordPlugin().read(file);
  RecordedSamples samples = recordPlugin().samples(file);
  const std::string plain = replay_page::page(recording, samples, "");
  samples.fingers.front().name = samples.bodies.front().name = "</script><script>alert(1)</script>";
  samples.faults = {"0.1 s: </script><img src=x onerror=alert(2)>"};
  const auto count = [](const std::string& page, const std::string& tag) {
    std::size_t found = 0;
    for (std::size_t at = 0; (at = page.find(tag, at)) != std::string::npos; ++at) ++found;
    return found;
  };
  const std::string page = replay_page::page(recording, samples, "");
  EXPECT_EQ(count(page, "<script"), count(plain, "<script"));
  EXPECT_EQ(count(page, "</script"), count(plain, "</script"));
  EXPECT_EQ(count(page, "<img"), 0u);
}

}  // namespace
}  // namespace presa
