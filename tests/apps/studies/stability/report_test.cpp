#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "apps/studies/stability/report.h"
#include "tests/apps/studies/stability/made_rows.h"
#include "tests/apps/support/support.h"

namespace presa::stability {
namespace {

using presa::test::browserMissing;
using presa::test::scratch;
using presa::test::shell;
using test::MadeRows;
using test::madeRows;

int countOf(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++count;
  return count;
}

/// The part of the page from `begin` to the next `end`.
std::string between(const std::string& page, const std::string& begin, const std::string& end) {
  const std::size_t from = page.find(begin);
  return from == std::string::npos ? "" : page.substr(from, page.find(end, from) - from);
}

std::string lineOf(const std::string& page, const std::string& name) {
  return between(page, "<tr data-case=\"" + name + "\"", "</tr>");
}
std::string caseOf(const std::string& page, const std::string& name) {
  return between(page, "<details class=\"case\" id=\"" + name + "\"", "</details>");
}

// A reader finds every case in the grid, and its line leads to the case.
TEST(StabilityPage, EachCaseIsOnceInTheGridAndOnceBelow) {
  const MadeRows made = madeRows(5);
  const std::string page = reportHtml(made.cases, made.rows);
  EXPECT_EQ(countOf(page, "<details"), 5);
  for (const Case& c : made.cases) {
    EXPECT_EQ(countOf(page, "<tr data-case=\"" + c.name + "\""), 1) << c.name;
    EXPECT_EQ(countOf(page, " id=\"" + c.name + "\""), 1) << c.name;
    EXPECT_EQ(countOf(lineOf(page, c.name), "href=\"#" + c.name + "\""), 1) << c.name;
  }
}

// What did not run is not on the page.
TEST(StabilityPage, ACaseWithoutRowsIsLeftOut) {
  MadeRows made = madeRows(3);
  std::erase_if(made.rows, [](const Row& row) { return row.case_name == "case_1"; });
  EXPECT_EQ(reportHtml(made.cases, made.rows).find("case_1\""), std::string::npos);
}

// A cell counts its findings: six for each method, here of two methods under "other rotation" and "other renderers".
TEST(StabilityPage, ACellCountsWhatIsStable) {
  MadeRows made = madeRows(1);
  made.rows.front().finding.verdict = Verdict::kDrift;
  made.rows.front().expected = Verdict::kDrift;
  const std::string line = lineOf(reportHtml(made.cases, made.rows), "case_0");
  EXPECT_EQ(countOf(line, "</span> 5/6"), 1) << line;
  EXPECT_EQ(countOf(line, "</span> 0/6"), 4) << line;
  EXPECT_EQ(countOf(line, "</span> 0/12"), 2) << line;
  EXPECT_NE(line.find("aria-label=\"drift\">◐"), std::string::npos) << line;
  EXPECT_EQ(countOf(line, "aria-label=\"unstable\">✕"), 6) << line;
  EXPECT_NE(line.find("force one tick late"), std::string::npos) << line;  // the column of all others names them
}

// What needs attention is in view without a click.
TEST(StabilityPage, OnlyCasesWorseThanExpectedAreOpen) {
  MadeRows made = madeRows(4);
  const std::string as_expected = reportHtml(made.cases, made.rows);
  EXPECT_EQ(countOf(as_expected, " open>"), 0);
  EXPECT_NE(as_expected.find("No verdict is worse than expected"), std::string::npos);
  for (Row& row : made.rows) {
    if (row.case_name == "case_2" && row.method == kPresa) row.finding.verdict = Verdict::kUnstable;
  }
  const std::string page = reportHtml(made.cases, made.rows);
  EXPECT_EQ(countOf(page, " open>"), 1);
  EXPECT_NE(caseOf(page, "case_2").find("\" open>"), std::string::npos);
  EXPECT_NE(caseOf(page, "case_2").find("6 worse than expected"), std::string::npos);
  EXPECT_NE(lineOf(page, "case_2").find("bad worse"), std::string::npos);
}

// A reference that all rows of a metric share is told once; one that changes stands with its parameters.
TEST(StabilityPage, AReferenceIsToldOnceWhereAllRowsShareIt) {
  const MadeRows made = madeRows(1);
  const std::string section = caseOf(reportHtml(made.cases, made.rows), "case_0");
  EXPECT_EQ(countOf(section, "held against k depth = 20 N; bound 1 mm/s"), 1);
  EXPECT_EQ(countOf(section, "<small>held against the closed form for 20 g</small>"), 1);
  EXPECT_EQ(countOf(section, "</b> bound 1 mm/s"), 1);
}

/// What `probe`, an expression of the script language, says of `root` in a browser: the page in a frame `width` px wide
/// whose address ends with `hash`.
std::istringstream seenInABrowser(const std::string& page, int width, const std::string& hash,
                                  const std::string& probe) {
  std::ofstream(scratch("page.html")) << page;
  // the window of a browser has a min width, a frame in it has none
  std::ofstream(scratch("frame.html"))
      << "<iframe src=\"page.html" + hash + "\" style=\"border: 0; height: 900px; width: " + std::to_string(width) +
             "px\"></iframe><script>const frame = document.querySelector('iframe'); frame.onload = () => {"
             "const root = frame.contentDocument.documentElement, cases = [...root.querySelectorAll('details')];"
             "document.body.dataset.probe = [" +
             probe + "].join(' '); };</script>";
  const auto seen = shell(
      "timeout 100 chromium --headless --no-sandbox --disable-gpu --disable-dev-shm-usage --disable-quic "
      "--no-first-run --disable-background-networking --disable-component-update --disable-sync "
      "--allow-file-access-from-files --enable-logging=stderr --window-size=1400,1000 --user-data-dir=" +
      scratch("profile") + " --dump-dom file://" + scratch("frame.html"));
  EXPECT_EQ(seen.err.find("CONSOLE"), std::string::npos) << seen.err;
  const std::size_t at = seen.out.find("data-probe=\"");
  EXPECT_NE(at, std::string::npos) << seen.err;
  return std::istringstream(at == std::string::npos ? "" : seen.out.substr(at + 12));
}

/// Whole height, width and visible width of a page, with all cases as they are or opened [px].
struct Extent {
  int height = 0, width = 0, visible = 0;
};

Extent extentOf(const std::string& page, int width, bool opened) {
  const std::string open = opened ? "cases.forEach(one => one.open = true), " : "";
  std::istringstream seen =
      seenInABrowser(page, width, "", "...(" + open + "[root.scrollHeight, root.scrollWidth, root.clientWidth])");
  Extent extent;
  seen >> extent.height >> extent.width >> extent.visible;
  return extent;
}

// The page of all cases is an overview: a few screens on a desk, and nothing lies beyond the edge of a phone, whatever
// is open. A screen is some 900 px; five and a half of them hold 45 lines of the grid and 45 closed cases.
TEST(StabilityPage, FitsADeskAndAPhone) {
  if (browserMissing()) GTEST_SKIP() << "no chromium here";
  const MadeRows made = madeRows(45);
  const std::string page = reportHtml(made.cases, made.rows);
  for (const int width : {1280, 390}) {
    for (const bool opened : {false, true}) {
      const Extent extent = extentOf(page, width, opened);
      EXPECT_GT(extent.height, 1000);
      EXPECT_LE(extent.width, extent.visible) << "at " << width << " px" << (opened ? ", opened" : "");
      if (width == 1280 && !opened) {
        EXPECT_LE(extent.height, 5000);
      }
      if (opened) {
        EXPECT_GT(extent.height, 20000);  // all cases did open
      }
    }
  }
}

// A link to a case opens it; two buttons open and close all. The page loads nothing.
TEST(StabilityPage, ALinkOpensItsCase) {
  if (browserMissing()) GTEST_SKIP() << "no chromium here";
  const MadeRows made = madeRows(5);
  std::istringstream seen =
      seenInABrowser(reportHtml(made.cases, made.rows), 1280, "#case_3",
                     "cases.filter(one => one.open).map(one => one.id), root.querySelector('.tools').hidden, "
                     "(root.querySelector('[data-open=all]').click(), cases.filter(one => one.open).length), "
                     "(root.querySelector('[data-open=none]').click(), cases.filter(one => one.open).length), "
                     "frame.contentWindow.performance.getEntriesByType('resource').length");
  std::string open, hidden;
  int after_all = -1, after_none = -1, requests = -1;
  seen >> open >> hidden >> after_all >> after_none >> requests;
  EXPECT_EQ(open, "case_3");
  EXPECT_EQ(hidden, "false");
  EXPECT_EQ(after_all, 5);
  EXPECT_EQ(after_none, 0);
  EXPECT_EQ(requests, 0);
}

/// The page with the rules of paper on the screen.
std::string printed(std::string page) {
  for (const auto& [from, to] : {std::pair{"@media print", "@media all"}, {"@media screen", "@media tty"}}) {
    const std::string text = from;
    for (std::size_t at = page.find(text); at != std::string::npos; at = page.find(text, at))
      page.replace(at, text.size(), to);
  }
  return page;
}

// On A4 (210 mm less margins of 14 mm: 688 px at 96 an inch) tables wrap and nothing is cut; closed cases stay out.
TEST(StabilityPage, FitsPaper) {
  if (browserMissing()) GTEST_SKIP() << "no chromium here";
  const MadeRows made = madeRows(5);
  const std::string page = printed(reportHtml(made.cases, made.rows));
  const Extent closed = extentOf(page, 688, false), opened = extentOf(page, 688, true);
  EXPECT_LE(opened.width, opened.visible);
  EXPECT_LE(closed.width, closed.visible);
  EXPECT_GT(opened.height, closed.height + 5 * 1000);
}

}  // namespace
}  // namespace presa::stability
