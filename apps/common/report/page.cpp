#include "apps/common/report/page.h"

#include <algorithm>
#include <cstdlib>

#include "apps/common/report/svg_plot.h"
#include "apps/common/report/svg_scale.h"

namespace presa::page {
namespace {

// Colours differ in lightness, for readers who cannot distinguish hues; print is always light.
const char* const kStyle = R"CSS(
:root { color-scheme: light dark;
  --bg: #ffffff; --card: #f6f7f9; --ink: #1b1f24; --soft: #5b6570; --rule: #dde1e6; --grid: #e7eaee;
  --band0: #eef3f8; --band1: #ffffff; --good: #0b7a53; --bad: #b3261e; --neutral: #44546a;
  --finger: #0b62a8; --proxy: #5aa9dc; --object: #c75a00; --force: #0b62a8; --tangential: #e08a00; --state: #1b1f24;
  --limit: #a0522d; --s0: #e8a33d; --s1: #1f8a8c; --s2: #3d2f86; --s3: #b0416e; --s4: #6a7d2c; --s5: #555f6b;
  --r0: #bcde28; --r1: #86d44a; --r2: #56c667; --r3: #32b47b; --r4: #21a187; --r5: #228e8d; --r6: #297a8e; --r7: #32668e; --r8: #3c508a; --r9: #443982; --r10: #481f70; --r11: #440154; }
@media screen and (prefers-color-scheme: dark) { :root {
  --bg: #14171b; --card: #1d2127; --ink: #e6e9ed; --soft: #9aa5b1; --rule: #343b44; --grid: #2a3038;
  --band0: #1c232b; --band1: #14171b; --good: #4cc38a; --bad: #ff8a80; --neutral: #a9b8cc;
  --finger: #5aa9e6; --proxy: #9fd0f5; --object: #ff9d4d; --force: #5aa9e6; --tangential: #ffc266; --state: #e6e9ed;
  --limit: #d9a066; --s0: #ffd48a; --s1: #3fbfb6; --s2: #8a7cf0; --s3: #e57ba4; --s4: #b4c86a; --s5: #a3adb8;
  --r0: #fde725; --r1: #d1e21c; --r2: #a3db37; --r3: #77d053; --r4: #51c46a; --r5: #33b57a; --r6: #22a685; --r7: #20958b; --r8: #24858e; --r9: #2b758e; --r10: #33648e; --r11: #3b528b; } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--bg); color: var(--ink); font: 15px/1.5 system-ui, "Liberation Sans", sans-serif; }
main { max-width: 1120px; margin: 0 auto; padding: 28px 20px 60px; }
h1 { font-size: 26px; line-height: 1.25; margin: 0 0 4px; }
h2 { font-size: 18px; margin: 36px 0 10px; }
h3 { font-size: 15px; margin: 18px 0 4px; }
p { margin: 6px 0; }
.lead { color: var(--soft); margin: 0 0 18px; }
.verdict { background: var(--card); border-left: 5px solid var(--neutral); border-radius: 4px; padding: 14px 18px; }
.verdict.good { border-color: var(--good); } .verdict.bad { border-color: var(--bad); }
.verdict b { font-size: 18px; } .verdict + .verdict { margin-top: 12px; } h1 + .verdict { margin-top: 14px; }
.verdict.good b { color: var(--good); } .verdict.bad b { color: var(--bad); }
.tiles { display: grid; grid-template-columns: repeat(auto-fit, minmax(165px, 1fr)); gap: 10px; margin: 14px 0; }
.tile { background: var(--card); border-radius: 4px; padding: 10px 14px; }
.tile span { display: block; color: var(--soft); font-size: 13px; }
.tile strong { font-size: 20px; font-variant-numeric: tabular-nums; }
.scroll { overflow-x: auto; } .scroll + .scroll { margin-top: 14px; }
table { border-collapse: collapse; width: 100%; font-variant-numeric: tabular-nums; font-size: 14px; }
th, td { padding: 5px 10px; text-align: right; border-bottom: 1px solid var(--rule); white-space: nowrap; }
th { color: var(--soft); font-weight: 600; white-space: normal; vertical-align: bottom; line-height: 1.25; }
th:first-child, td:first-child { text-align: left; padding-left: 0; }
table.facts td { text-align: left; white-space: normal; overflow-wrap: anywhere; }
table.facts td:first-child { color: var(--soft); width: 170px; white-space: nowrap; vertical-align: top; }
td > code { display: inline-block; white-space: normal; overflow-wrap: anywhere; text-align: left; min-width: 240px; }
th.words, td.words { white-space: normal; text-align: left; } td.good { color: var(--good); } td.warn { color: var(--limit); } td.bad { color: var(--bad); }
a { color: inherit; text-decoration-color: var(--soft); }
.save { color: var(--soft); font-size: 12px; margin: 0 0 10px; }
.caption, .empty { color: var(--soft); font-size: 14px; }
ul { margin: 6px 0; padding-left: 20px; }
.fault { color: var(--bad); } .warning { color: var(--limit); }
code { font: 13px/1.5 ui-monospace, "DejaVu Sans Mono", monospace; }
pre { background: var(--card); border-radius: 4px; padding: 10px 14px; white-space: pre-wrap; overflow-wrap: anywhere; margin: 8px 0; }
img { max-width: 100%; border-radius: 4px; display: block; }
.pair { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 440px), 1fr)); gap: 16px; }
.plot { position: relative; overflow-x: auto; }
.plot > svg { width: 100%; height: auto; display: block; } .plot.single { max-width: 800px; }
details { margin: 8px 0; } summary { cursor: pointer; color: var(--soft); font-size: 14px; }
details.part { margin: 0; border-top: 1px solid var(--rule); padding: 10px 0; } details.part:last-of-type { border-bottom: 1px solid var(--rule); }
details.part > summary { color: var(--ink); font-size: 16px; font-weight: 600; } h2 + details.part { margin-top: 4px; }
figure { margin: 0; } figure + .verdict { margin-top: 16px; } figure > h3 { margin-top: 12px; }
svg text { font: 12px system-ui, "Liberation Sans", sans-serif; fill: var(--ink); }
svg .tick { fill: var(--soft); font-variant-numeric: tabular-nums; } svg .ytick { text-anchor: end; } svg .xtick, svg .phase { text-anchor: middle; }
svg .phase { fill: var(--soft); font-weight: 600; } svg .panel-title { font-weight: 600; font-size: 13px; }
svg .legend { paint-order: stroke; stroke: var(--bg); stroke-width: 4px; }
svg .level-label { text-anchor: end; fill: var(--limit); } svg .halo { paint-order: stroke; stroke: var(--bg); stroke-width: 4px; }
svg .event { stroke: var(--bad); stroke-width: 1.5; } svg .event-label { fill: var(--bad); font-weight: 600; } svg .event-label.end { text-anchor: end; }
svg .span { fill: var(--object); fill-opacity: .22; } svg .span1 { fill-opacity: .4; }
svg .grid { stroke: var(--grid); } svg .axis { stroke: var(--soft); } svg .cursor { stroke: var(--soft); visibility: hidden; }
svg .band0 { fill: var(--band0); } svg .band1 { fill: var(--band1); }
svg .line { fill: none; stroke-width: 1.8; stroke-linejoin: round; }
svg .finger { stroke: var(--finger); } svg .proxy { stroke: var(--proxy); stroke-dasharray: 6 4; } svg .object { stroke: var(--object); }
svg .force { stroke: var(--force); } svg .tangential { stroke: var(--tangential); } svg .thin { stroke: var(--soft); stroke-width: 1; } svg .thin.second { stroke-dasharray: 2 2; } svg .state { stroke: var(--state); }
svg .level { stroke: var(--limit); stroke-dasharray: 3 3; }
svg .dots { fill: none; stroke-width: 3; stroke-linecap: round; stroke-opacity: .75; } svg .dots.big { stroke-width: 8; }
svg .stick { stroke: var(--force); } svg .slip { stroke: var(--object); }
svg .ray { stroke-width: 1.5; } svg .static { stroke: var(--ink); } svg .dynamic { stroke: var(--soft); stroke-dasharray: 5 4; }
svg .mark { fill: none; stroke: var(--bad); stroke-width: 2; }
svg .point { fill: var(--tangential); stroke: var(--bg); stroke-width: 1; cursor: default; } svg .point.front { fill: var(--force); }
svg .point.usual { fill: var(--object); stroke: var(--ink); stroke-width: 1.5; } svg .point.empty { fill: var(--bg); stroke: var(--tangential); stroke-width: 1.5; }
svg .cross { stroke: var(--bad); stroke-width: 2; fill: none; } svg .whisker { stroke: var(--tangential); }
svg .work { stroke-width: 1.3; fill: var(--fill); cursor: default; } svg .work.front { stroke: var(--ink); }
svg .work.other { fill-opacity: .35; } svg .work.empty { fill: var(--bg); fill-opacity: 1; } svg .leader { stroke: var(--soft); stroke-width: .8; }
svg .pareto { fill: none; stroke: var(--force); stroke-width: 1.5; } svg .floor { fill: var(--band0); } svg .known { fill: var(--limit); }
svg .s0 { stroke: var(--s0); --fill: var(--s0); } svg .s1 { stroke: var(--s1); --fill: var(--s1); } svg .s2 { stroke: var(--s2); --fill: var(--s2); }
svg .s3 { stroke: var(--s3); --fill: var(--s3); } svg .s4 { stroke: var(--s4); --fill: var(--s4); } svg .s5 { stroke: var(--s5); --fill: var(--s5); }
svg .r0 { stroke: var(--r0); --fill: var(--r0); } svg .r1 { stroke: var(--r1); --fill: var(--r1); } svg .r2 { stroke: var(--r2); --fill: var(--r2); }
svg .r3 { stroke: var(--r3); --fill: var(--r3); } svg .r4 { stroke: var(--r4); --fill: var(--r4); } svg .r5 { stroke: var(--r5); --fill: var(--r5); }
svg .r6 { stroke: var(--r6); --fill: var(--r6); } svg .r7 { stroke: var(--r7); --fill: var(--r7); } svg .r8 { stroke: var(--r8); --fill: var(--r8); }
svg .r9 { stroke: var(--r9); --fill: var(--r9); } svg .r10 { stroke: var(--r10); --fill: var(--r10); } svg .r11 { stroke: var(--r11); --fill: var(--r11); }
svg .ink { stroke: var(--ink); --fill: var(--ink); } svg .bar { fill: var(--fill); stroke: none; } svg .symbol { fill: var(--fill); fill-opacity: .55; }
svg .area { fill: var(--fill); fill-opacity: .18; stroke: none; } svg .error { stroke: var(--ink); stroke-width: 1.1; fill: none; } svg .dashed { stroke-dasharray: 6 4; }
svg [data-name]:hover { stroke: var(--ink); stroke-width: 2.5; }
.readout { position: absolute; top: 50px; pointer-events: none; background: var(--bg); border: 1px solid var(--rule); border-radius: 4px;
  padding: 6px 10px; font-size: 13px; font-variant-numeric: tabular-nums; white-space: nowrap; }
.readout div { display: flex; justify-content: space-between; gap: 18px; }
.readout span { color: var(--soft); }
@media screen and (max-width: 700px) { .plot > svg { min-width: 640px; } .pair .plot > svg { min-width: 0; }
  .pair figure svg text { font-size: 13px; } .verdict b { overflow-wrap: anywhere; } }
@media print {
  @page { margin: 14mm; } body { font-size: 11pt; } main { padding: 0; max-width: none; }
  * { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
  .plot, .tiles, .verdict, tr, pre, img, figure { break-inside: avoid; } thead { display: table-header-group; }
  h1, h2, h3, .lead, summary, h2 + .caption, h3 + .caption { break-after: avoid; } p { orphans: 3; widows: 3; } .readout, .save { display: none; }
  .pair { grid-template-columns: 1fr 1fr; } .plot, .scroll { overflow: visible; } }
)CSS";

// Shows the values under the pointer; the rest of the page works without it.
const char* const kScript = R"JS(
for (const plot of document.querySelectorAll('.plot')) {
  const block = plot.querySelector('script[type="application/json"]');
  if (!block) continue;
  const data = JSON.parse(block.textContent);
  const svg = plot.querySelector('svg'), cursor = svg.querySelector('.cursor'), box = plot.querySelector('.readout');
  const nearest = t => {
    let low = 0, high = data.time.length - 1;
    while (high - low > 1) { const mid = (low + high) >> 1; if (data.time[mid] < t) low = mid; else high = mid; }
    return t - data.time[low] < data.time[high] - t ? low : high;
  };
  const row = (name, value) => {
    const div = document.createElement('div'), span = document.createElement('span');
    span.textContent = name; div.append(span, value); return div;
  };
  const hide = () => { box.hidden = true; cursor.style.visibility = 'hidden'; };
  svg.addEventListener('pointermove', event => {
    const area = svg.getBoundingClientRect();
    const x = (event.clientX - area.left) / area.width * svg.viewBox.baseVal.width;
    if (x < data.x0 || x > data.x1) return hide();
    const t = data.t0 + (x - data.x0) / (data.x1 - data.x0) * (data.t1 - data.t0), i = nearest(t);
    const at = data.x0 + (data.time[i] - data.t0) / (data.t1 - data.t0) * (data.x1 - data.x0);
    cursor.setAttribute('x1', at); cursor.setAttribute('x2', at); cursor.style.visibility = 'visible';
    const band = data.bands.find(b => b[1] <= data.time[i] && data.time[i] < b[2]);
    box.replaceChildren(row(band ? band[0] : 'time', data.time[i].toFixed(3) + ' s'));
    for (const s of data.series) {
      const y = s.y[i];
      box.append(row(s.label, y === null ? '\u2013' : s.names.length ? s.names[y] : y.toPrecision(4) + ' ' + s.unit));
    }
    box.hidden = false;
    const left = at / svg.viewBox.baseVal.width * area.width;
    box.style.left = (left + box.offsetWidth + 24 > area.width ? left - box.offsetWidth - 12 : left + 12) + 'px';
  });
  svg.addEventListener('pointerleave', hide);
}
for (const point of document.querySelectorAll('.plot [data-name]')) {
  const plot = point.closest('.plot'), box = plot.querySelector('.readout');
  point.addEventListener('pointerenter', () => {
    box.replaceChildren(...point.dataset.name.split('\n').map(line => {
      const div = document.createElement('div'); div.textContent = line; return div;
    }));
    box.hidden = false;
    const area = plot.getBoundingClientRect(), at = point.getBoundingClientRect(), x = at.right - area.left, y = at.top - area.top;
    box.style.left = (x + box.offsetWidth + 20 > area.width ? Math.max(0, at.left - area.left - box.offsetWidth - 8) : x + 8) + 'px';
    box.style.top = Math.max(0, y - box.offsetHeight / 2) + 'px';
  });
  point.addEventListener('pointerleave', () => { box.hidden = true; });
}
)JS";

}  // namespace

std::string head(const std::string& title, const std::string& style) {
  return "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
         // the browser then guarantees that the page sends no request
         "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; "
         "script-src 'unsafe-inline'; img-src data:\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
         svg::escape(title) + "</title>\n<style>" + kStyle + style + "</style></head>\n<body><main>\n";
}

const char* style() { return kStyle; }

std::string tail() { return std::string("</main>\n<script>") + kScript + "</script>\n</body></html>\n"; }

namespace {

/// The title of a picture `width` wide; one that is too long for it is squeezed.
std::string titleAbove(const std::string& title, double width) {
  constexpr double kLeft = 62, kLetter = 7.4;  // of the style's font, or one as wide
  const auto letters = std::count_if(title.begin(), title.end(), [](char c) { return (c & 0xC0) != 0x80; });
  const double room = width - kLeft - kLetter;
  const bool fits = static_cast<double>(letters) * kLetter <= room;
  return "<text class=\"panel-title\" x=\"62\" y=\"18\"" +
         (fits ? "" : " textLength=\"" + svg::px(room) + "\" lengthAdjust=\"spacingAndGlyphs\"") + ">" +
         svg::escape(title) + "</text>";
}

}  // namespace

std::string picture(const std::string& figure_html, const std::string& title) {
  const std::size_t begin = figure_html.find("<svg "), inside = figure_html.find('>', begin);
  const std::size_t end = figure_html.find("</svg>");
  const std::size_t size = figure_html.find("viewBox=\"0 0 ", begin);
  if (begin == std::string::npos || end == std::string::npos || size >= inside) return {};
  const double width = std::strtod(figure_html.c_str() + size + 13, nullptr);
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" " + figure_html.substr(begin + 5, inside - begin - 4) +
         "\n<style>" + kStyle + "svg { background: var(--bg); }</style>\n" + titleAbove(title, width) +
         figure_html.substr(inside + 1, end - inside - 1) + "</svg>\n";
}

}  // namespace presa::page
