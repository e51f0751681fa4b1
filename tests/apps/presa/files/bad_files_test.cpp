#include <gtest/gtest.h>

#include <filesystem>

#include "tests/apps/presa/files/program.h"

// Each kind of input file, replaced by one that blocks, never ends, is too large, or lies in a forbidden folder. The
// program must report the finding with exit status 2 before the 60 s after which a command counts as hanging (status
// 124).
namespace presa {
namespace {

namespace fs = std::filesystem;
using test::Bench;
using test::Outcome;

const std::string kCube = test::kSource + "/config/scenes/cube.xml";

class BadFile : public testing::Test {
 protected:
  void expectRefused(const std::string& arguments, const std::string& code, const std::string& words) const {
    const Outcome outcome = bench.presa(arguments);
    EXPECT_EQ(outcome.status, 2) << outcome.text;
    EXPECT_NE(outcome.text.find("error[" + code + "]"), std::string::npos) << outcome.text;
    EXPECT_NE(outcome.text.find(words), std::string::npos) << outcome.text;
  }

  const Bench bench;
};

TEST_F(BadFile, SceneThatIsAPipe) {
  bench.fifo("scene.xml");
  expectRefused("check scene.xml", "E690", "scene.xml: error");
  expectRefused("run scene.xml --lockstep", "E690", "named pipe");
  expectRefused("cost scene.xml --quick", "E690", "named pipe");
}

TEST_F(BadFile, RigThatIsAPipe) {
  bench.fifo("rig.xml");
  expectRefused("check " + kCube + " --rig rig.xml", "E690", "rig.xml: error");
}

TEST_F(BadFile, ExperimentThatIsAPipe) {
  bench.fifo("experiment.xml");
  expectRefused("experiment dry-run experiment.xml", "E690", "experiment.xml: error");
}

TEST_F(BadFile, MotionsThatArePipes) {
  for (const std::string name : {"motion.csv", "motion.xml"}) {
    bench.fifo(name);
    bench.writeRig("scripted", "motion", name);
    expectRefused("check " + kCube + " --rig rig.xml", "E690", name + ": error");
  }
}

// The link leads out of the allowed folders; where that is allowed, the target is still a device.
TEST_F(BadFile, MotionWithoutAnEnd) {
  fs::create_symlink("/dev/zero", bench.file("motion.csv"));
  bench.writeRig("scripted", "motion", "motion.csv");
  expectRefused("check " + kCube + " --rig rig.xml", "E692", "(/dev/zero) lies outside");
  expectRefused("check " + kCube + " --rig rig.xml --allow-folder /dev", "E690", "a device of the system");
}

TEST_F(BadFile, FirmwareThatIsAPipe) {
  bench.fifo("firmware.bin");
  bench.writeRig("novint_falcon", "firmware", "firmware.bin");
  expectRefused("check " + kCube + " --rig rig.xml", "E690", "firmware.bin' is a named pipe");
}

TEST_F(BadFile, RecordingsThatArePipes) {
  bench.fifo("run.h5");
  expectRefused("replay run.h5 --verify", "E690", "run.h5: error");
  bench.writeRig("replay", "file", "run.h5");
  expectRefused("check " + kCube + " --rig rig.xml", "E441", "run.h5: error[E690]: is a named pipe");
}

TEST_F(BadFile, JournalThatIsAPipe) {
  bench.fifo("data/sub-S01/ses-1/journal.jsonl");
  expectRefused("experiment resume data", "E690", "journal.jsonl: error");
  expectRefused("experiment export data --csv out", "E690", "journal.jsonl: error");
  const Outcome validated = bench.presa("experiment validate data");
  EXPECT_EQ(validated.status, 1) << validated.text;
  EXPECT_NE(validated.text.find("ALTERED"), std::string::npos) << validated.text;
  const Outcome begun = bench.presa("experiment run " + test::kSource +
                                    "/tests/apps/experiment/fixtures/lift.xml --subject S01 --lockstep --data data");
  EXPECT_EQ(begun.status, 2) << begun.text;
}

TEST_F(BadFile, MeshThatIsSparse) {
  bench.write("mesh.stl", "");
  fs::resize_file(bench.file("mesh.stl"), std::uint64_t{2} << 30U);
  bench.writeMeshScene("mesh.stl");
  expectRefused("check scene.xml", "E691", "has 2147483648 bytes, at most 268435456 are read");
}

class BadPartOfAMesh : public BadFile {
 protected:
  void writeObj(const std::string& library) const {
    bench.write("mesh.obj",
                "mtllib " + library + "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    bench.writeMeshScene("mesh.obj");
  }
  void writeGltf(const std::string& buffer) const {
    bench.write("mesh.gltf", R"({"asset":{"version":"2.0"},"buffers":[{"uri":")" + buffer + R"(","byteLength":36}],
"bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}],"scene":0})");
    bench.writeMeshScene("mesh.gltf");
  }
};

TEST_F(BadPartOfAMesh, ThatIsAPipe) {
  bench.fifo("library.mtl");
  writeObj("library.mtl");
  expectRefused("check scene.xml", "E690", "library.mtl', which it names, is a named pipe");
  bench.fifo("buffer.bin");
  writeGltf("buffer.bin");
  expectRefused("check scene.xml", "E690", "buffer.bin', which it names, is a named pipe");
}

TEST_F(BadPartOfAMesh, ThatLiesElsewhere) {
  const std::string up = "../../../../etc/passwd";
  writeObj(up);
  expectRefused("check scene.xml", "E692", "etc/passwd' lies outside");
  writeGltf(up);
  expectRefused("check scene.xml", "E692", "etc/passwd' lies outside");
  EXPECT_EQ(bench.shell("cat output").text.find("root:"), std::string::npos);
}

// Many meshes name a missing material file; such a mesh is accepted.
TEST_F(BadPartOfAMesh, ThatIsNotThereIsDoneWithout) {
  for (const std::string library : {"none.mtl", "../none.mtl", "/nowhere/none.mtl"}) {
    writeObj(library);
    const Outcome outcome = bench.presa("check scene.xml");
    EXPECT_EQ(outcome.status, 0) << library << outcome.text;
  }
  writeObj("library.mtl");
  bench.write("library.mtl", "newmtl a\nKd 1 0 0\n");
  EXPECT_EQ(bench.presa("check scene.xml").status, 0);
}

// All kinds of files that files name, located one folder up.
TEST_F(BadFile, NamedElsewhere) {
  bench.write("lab/rig.xml", "<rig version=\"1.0\" name=\"r\"/>");
  bench.write("mesh.obj", "v 0 0 0\n");
  bench.write("motion.csv", "time_s\n");
  bench.writeMeshScene("../mesh.obj");
  fs::rename(bench.file("scene.xml"), bench.file("lab/scene.xml"));
  expectRefused("check lab/scene.xml", "E692", "mesh.obj' lies outside");
  bench.writeRig("scripted", "motion", "../motion.csv");
  fs::rename(bench.file("rig.xml"), bench.file("lab/rig.xml"));
  expectRefused("check " + kCube + " --rig lab/rig.xml", "E692", "rig.xml:2:");
  bench.writeRig("novint_falcon", "firmware", "../motion.csv");
  fs::rename(bench.file("rig.xml"), bench.file("lab/rig.xml"));
  expectRefused("check " + kCube + " --rig lab/rig.xml", "E692", "motion.csv' lies outside");
  bench.write("lab/cube.xml",
              "<scene version=\"1.0\" name=\"c\" rig=\"../other.xml\"><world gravity=\"0 0 -9.81\"/>"
              "<materials><material name=\"a\" stiffness=\"1\"/></materials><body name=\"b\" "
              "fixed=\"true\"><haptic><sphere radius=\"0.1\"/></haptic></body></scene>");
  expectRefused("check lab/cube.xml", "E692", "other.xml' lies outside");
  bench.write("lab/experiment.xml",
              "<experiment version=\"1.0\" name=\"e\" scene=\"../scene.xml\" rig=\"rig.xml\" seed=\"1\"><design/>"
              "<phase name=\"p\" seconds=\"1\"/></experiment>");
  expectRefused("experiment dry-run lab/experiment.xml", "E692", "lab/experiment.xml:1:");
}

// Accepted when the user asks for it: the folder of a file on the command line, and --allow-folder.
TEST_F(BadFile, NamedElsewhereWhereThatIsAllowed) {
  const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  bench.write("meshes/mesh.obj", obj);
  bench.writeMeshScene("../meshes/mesh.obj");
  fs::create_directory(bench.file("scenes"));
  fs::rename(bench.file("scene.xml"), bench.file("scenes/scene.xml"));
  EXPECT_EQ(bench.presa("check scenes/scene.xml").status, 2);
  EXPECT_EQ(bench.presa("check scenes/scene.xml --allow-folder meshes").status, 0);
  EXPECT_EQ(bench.presa("check scenes/scene.xml --allow-folder .").status, 0);
  EXPECT_EQ(bench.shell("PRESA_ALLOW_FOLDERS=/usr:meshes exec " + test::kProgram + " check scenes/scene.xml").status,
            0);
  const Outcome set =
      bench.presa("check scenes/scene.xml --set body/b/haptic/mesh/file=" + bench.file("meshes/mesh.obj"));
  EXPECT_EQ(set.status, 0) << set.text;
}

// A list of checksums names files in its own folder only.
TEST_F(BadFile, ChecksumOfAFileElsewhere) {
  const std::string lift = test::kSource + "/tests/apps/experiment/fixtures/lift.xml";
  ASSERT_EQ(bench.presa("experiment run " + lift + " --subject S01 --lockstep --no-recording --data data").status, 0);
  const std::string forge = R"(python3 - <<'END'
import hashlib, json
name = 'data/sub-S01/ses-1/journal.jsonl'
lines, before = [], ''
for line in open(name):
    record = line[line.index('"record":') + 9:-2]
    if '"event":"start"' in record:
        record = record.replace('"sha256":{', '"sha256":{"../../../secret":"00",', 1)
    before = hashlib.sha256((before + record).encode()).hexdigest()
    lines.append('{"sha256":"' + before + '","record":' + record + '}\n')
open(name, 'w').writelines(lines)
END
)";
  bench.write("secret", "not for hashing");
  ASSERT_EQ(bench.shell(forge).status, 0);
  const Outcome outcome = bench.presa("experiment validate data");
  EXPECT_NE(outcome.status, 0);
  EXPECT_NE(outcome.text.find("which is no file of its own folder"), std::string::npos) << outcome.text;
  expectRefused("experiment export data --csv out", "E924", "'../../../secret'");
}

}  // namespace
}  // namespace presa
