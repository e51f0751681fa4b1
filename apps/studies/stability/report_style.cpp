#include "apps/studies/stability/report_style.h"

namespace presa::stability {

// The fills of the grid differ in lightness from the page, not from each other: signs tell them apart without colour.
const char* const kReportStyle = R"CSS(
:root { --good-fill: #d8efe5; --warn-fill: #f8e6c4; --bad-fill: #f8d5d1; }
@media screen and (prefers-color-scheme: dark) {
  :root { --good-fill: #16392c; --warn-fill: #4a3815; --bad-fill: #55231f; } }
@media screen { main { max-width: 1240px; } }
.sign { font-family: "DejaVu Sans", system-ui, sans-serif; } .count { white-space: nowrap; }
small { font-size: 12px; color: var(--soft); }
td.fill small, td.fill, td.fill.warn, td.fill.bad, td.fill.good { color: var(--ink); }
.fill.good { background: var(--good-fill); } .fill.warn { background: var(--warn-fill); }
.fill.bad { background: var(--bad-fill); }
.fill.worse { outline: 2px solid var(--bad); outline-offset: -2px; font-weight: 700; }
table.overview { border-collapse: separate; border-spacing: 2px 0; }
table.overview th, table.overview td { padding: 2px 8px; white-space: normal; line-height: 1.35;
  border-bottom: 1px solid var(--bg); }
table.overview tbody tr { position: relative; }
table.overview tbody th { color: var(--ink); font-weight: 400; min-width: 400px; vertical-align: middle; }
table.overview th:first-child { padding-left: 0; } table.overview thead th { text-align: left; }
table.overview td { text-align: left; min-width: 78px; }
table.overview td.share, table.overview thead th:last-child { text-align: right; min-width: 76px; }
table.overview td small { display: block; line-height: 1.2; min-width: 120px; }
table.overview a::after { content: ""; position: absolute; inset: 0; }
table.overview tbody tr:hover th { background: var(--card); }
.tools button { font: inherit; font-size: 14px; color: var(--ink); background: var(--card);
  border: 1px solid var(--rule); border-radius: 4px; padding: 3px 12px; margin-right: 6px; cursor: pointer; }
details.case .plot + .scroll { margin-top: 14px; }
details.case { margin: 0; border-top: 1px solid var(--rule); scroll-margin-top: 8px; }
details.case > summary { color: var(--ink); padding: 4px 0; } details.case[open] { padding-bottom: 24px; }
details.case[open] > summary b { font-size: 18px; } details.case > summary b { font-weight: 600; }
summary .fill { border-radius: 4px; padding: 1px 8px; margin-left: 8px; font-size: 13px; white-space: nowrap; }
table.rows th:first-child { min-width: 220px; white-space: normal; vertical-align: top; }
table.rows tbody th { text-align: left; color: var(--ink); font-weight: 400; padding: 5px 10px 5px 0; }
table.rows tbody th small { display: block; }
table.rows td { white-space: normal; vertical-align: top; min-width: 112px; } table.rows thead th { min-width: 112px; }
table.rows td.none { color: var(--soft); }
table.rows tr.metric th { padding-top: 14px; border-bottom: 2px solid var(--rule); color: var(--soft); }
table.rows tr.metric b { color: var(--ink); margin-right: 8px; }
table.rows tr.metric div { position: sticky; left: 0; max-width: min(1200px, calc(100vw - 40px)); }
.caption code { overflow-wrap: anywhere; }
@media screen and (max-width: 700px) {
  table.overview, table.overview tbody { display: block; }
  table.overview thead, table.overview td.none { display: none; }
  table.overview tbody tr { display: flex; flex-wrap: wrap; gap: 4px; padding: 7px 0; border-bottom: 1px solid var(--rule); }
  table.overview tbody th { display: block; flex: 0 0 100%; min-width: 0; padding: 0; }
  table.overview td, table.overview td.share { display: block; min-width: 0; border: 0; text-align: left; }
  table.overview td small { display: none; }
  table.overview td::before { content: attr(data-family) " "; color: var(--soft); font-size: 12px; }
  table.rows th:first-child { min-width: 170px; } table.rows td, table.rows thead th { min-width: 92px; }
}
@media print {
  details.case:not([open]), .tools { display: none; }
  table { font-size: 9pt; } table.overview, table.rows { break-inside: auto; } tr { break-inside: avoid; }
  table.overview th, table.overview td, table.rows th, table.rows td, table.rows th:first-child, table.overview tbody th {
    min-width: 0; padding: 2px 4px; white-space: normal; }
  table.overview td small { min-width: 0; }
  table.rows th:first-child { width: 30%; } table.overview tbody th { width: 34%; }
  table.rows { table-layout: fixed; overflow-wrap: anywhere; } table.rows .count { white-space: normal; }
  table.rows tr.metric { break-after: avoid; } table.rows tr.metric div { position: static; max-width: none; }
}
)CSS";

const char* const kReportScript = R"JS(
{
  const cases = document.querySelectorAll('details.case'), tools = document.querySelector('.tools');
  tools.hidden = false;
  for (const button of tools.querySelectorAll('button'))
    button.addEventListener('click', () => { for (const one of cases) one.open = button.dataset.open === 'all'; });
  const reveal = () => {
    const one = document.getElementById(decodeURIComponent(location.hash.slice(1)));
    if (one && one.matches('details.case')) { one.open = true; one.scrollIntoView(); }
  };
  addEventListener('hashchange', reveal);
  for (const link of document.querySelectorAll('table.overview a'))
    link.addEventListener('click', () => { if (link.hash === location.hash) reveal(); });
  reveal();
}
)JS";

}  // namespace presa::stability
