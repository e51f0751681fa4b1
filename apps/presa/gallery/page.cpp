#include "apps/presa/gallery/page.h"

#include "apps/common/file_text.h"
#include "apps/common/report/base64.h"
#include "apps/common/report/page.h"
#include "apps/common/report/svg_plot.h"
#include "apps/presa/gallery/groups.h"

namespace presa::gallery {
namespace {

using svg::escape;

const char* const kStyle = R"CSS(
nav { display: flex; flex-wrap: wrap; gap: 4px 16px; margin: 0 0 8px; }
.scenes { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 250px), 1fr)); gap: 18px 16px; }
.scenes figure { background: var(--card); border-radius: 4px; overflow: hidden; display: flex; flex-direction: column; }
.scenes img { width: 100%; height: auto; aspect-ratio: 16 / 9; border-radius: 0; background: var(--rule); }
.scenes figcaption { padding: 10px 12px 12px; display: flex; flex-direction: column; flex: 1; gap: 4px; }
.scenes h3 { margin: 0; overflow-wrap: anywhere; } .scenes p { margin: 0; font-size: 14px; flex: 1; }
.scenes code { color: var(--soft); overflow-wrap: anywhere; }
)CSS";

std::string card(const Entry& entry) {
  const std::string name = escape(entry.name);
  std::string out = "<figure id=\"" + name + "\">";
  if (!entry.picture.empty())
    out += "<img width=\"320\" height=\"180\" alt=\"" + escape(entry.sentence) + "\" src=\"data:image/png;base64," +
           base64(contentsOf(entry.picture)) + "\">";
  return out + "<figcaption><h3>" + name + "</h3><p>" + escape(entry.sentence) + "</p><code>presa gallery " + name +
         "</code></figcaption></figure>\n";
}

}  // namespace

std::string page(const std::vector<Entry>& entries) {
  std::string links, sections;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const std::string& group = entries[i].group;
    if (i == 0 || group != entries[i - 1].group) {
      const std::string title = escape(titleOf(group)), anchor = "group-" + escape(group);
      links += "<a href=\"#" + anchor + "\">" + title + "</a>\n";
      sections +=
          (i == 0 ? "" : "</div>\n") + ("<h2 id=\"" + anchor + "\">" + title + "</h2>\n<div class=\"scenes\">\n");
    }
    sections += card(entries[i]);
  }
  return page::head("Presa: the gallery", kStyle) + "<h1>One scene, one idea</h1>\n<p class=\"lead\">The " +
         std::to_string(entries.size()) +
         " scenes that Presa ships. Each runs by its command; with <code>--mouse</code> behind it, mouse and keys move "
         "the fingers. In the window of a scene, the key m shows the menu of all.</p>\n<nav>" +
         links + "</nav>\n" + sections + "</div>\n" + page::tail();
}

}  // namespace presa::gallery
