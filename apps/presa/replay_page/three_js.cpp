#include "apps/presa/replay_page/three_js.h"

#include <cstdlib>
#include <sstream>

#include "apps/common/file_text.h"
#include "framework/core/diagnostics/refuse.h"

namespace presa::replay_page {
namespace {

// The licence asks for this in every copy.
constexpr const char* kLicence =
    "/* three.js, https://threejs.org. The MIT License. Copyright 2010-2019 three.js authors.\n"
    "Permission is hereby granted, free of charge, to any person obtaining a copy of this software and associated\n"
    "documentation files (the \"Software\"), to deal in the Software without restriction, including without "
    "limitation\n"
    "the rights to use, copy, modify, merge, publish, distribute, sublicense, and/or sell copies of the Software, and "
    "to\n"
    "permit persons to whom the Software is furnished to do so, subject to the following conditions:\n"
    "The above copyright notice and this permission notice shall be included in all copies or substantial portions of\n"
    "the Software.\n"
    "THE SOFTWARE IS PROVIDED \"AS IS\", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR IMPLIED, INCLUDING BUT NOT LIMITED "
    "TO\n"
    "THE WARRANTIES OF MERCHANTABILITY, FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE\n"
    "AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER LIABILITY, WHETHER IN AN ACTION OF "
    "CONTRACT,\n"
    "TORT OR OTHERWISE, ARISING FROM, OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN THE\n"
    "SOFTWARE. */\n";

std::string dataFolders() {
  const char* named = std::getenv("XDG_DATA_DIRS");
  return named != nullptr && *named != '\0' ? named : "/usr/local/share:/usr/share";
}

}  // namespace

std::string threeJs() {
  std::istringstream folders(dataFolders());
  for (std::string folder; std::getline(folders, folder, ':');) {
    const std::filesystem::path three = std::filesystem::path(folder) / "javascript/three";
    const std::string library = contentsOf(three / "three.min.js");
    const std::string controls = contentsOf(three / "examples/js/controls/OrbitControls.js");
    if (library.empty() || controls.empty()) continue;
    std::string scripts = "<script>";
    scripts.append(kLicence).append(library).append("</script>\n<script>").append(controls).append("</script>\n");
    return scripts;
  }
  refuse(127, "--page", "the 3-D view of the page needs three.js, which is not in " + dataFolders(),
         "install it: sudo apt-get install libjs-three");
}

}  // namespace presa::replay_page
