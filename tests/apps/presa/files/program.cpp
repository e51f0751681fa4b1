#include "tests/apps/presa/files/program.h"

#include <sys/stat.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "apps/common/file_text.h"

namespace presa::test {

void Bench::write(const std::string& name, const std::string& text) const {
  std::filesystem::create_directories(std::filesystem::path(file(name)).parent_path());
  std::ofstream(file(name)) << text;
}

void Bench::fifo(const std::string& name) const {
  std::filesystem::create_directories(std::filesystem::path(file(name)).parent_path());
  if (::mkfifo(file(name).c_str(), 0600) != 0) throw std::runtime_error("no FIFO " + name);
}

Outcome Bench::shell(const std::string& command) const {
  const std::string out = file("output");
  const std::string all = "cd '" + scratch_.path().string() + "' && ( " + command + " ) >'" + out + "' 2>&1";
  const int status = std::system(all.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), contentsOf(out)};
}

void Bench::writeMeshScene(const std::string& mesh) const {
  write("scene.xml", R"(<scene version="1.0" name="m"><world gravity="0 0 -9.81"/>
<materials><material name="a" stiffness="1000" damping="1"/></materials>
<body name="b" fixed="true"><haptic><mesh file=")" +
                         mesh + R"("/></haptic></body></scene>)");
}

void Bench::writeRig(const std::string& driver, const std::string& key, const std::string& value) const {
  const std::string rest = "\" driver=\"" + driver + "\"><set key=\"" + key + "\" value=\"" + value + "\"/></device>\n";
  write("rig.xml",
        "<rig version=\"1.0\" name=\"r\">\n<device role=\"thumb" + rest + "<device role=\"index" + rest + "</rig>");
}

}  // namespace presa::test
