#include "mote/report/page.hpp"

#include <stdexcept>

#include "mote/report/text.hpp"

namespace mote::report {
namespace {

const std::string kNasty = "</script><script>alert('x')</script> & \"Ω\"";
const std::string kNastyEscaped = "&lt;/script&gt;&lt;script&gt;alert(&#39;x&#39;)&lt;/script&gt; &amp; &quot;Ω&quot;";

Page full_page(const std::string& name) {
  return {.title = name,
          .summary = name,
          .command = "mote run ungm --data 'a<b.csv' # " + name,
          .facts = {{name, name}},
          .charts = {{.title = name,
                      .x_label = name,
                      .y_label = name,
                      .bands = {{name, {1}, {0}, {2}}},
                      .series = {{name, Series::Mark::kLine, {1}, {1}}}}},
          .tables = {{name, {name, "value"}, {{name, "1.5"}}}},
          .notes = {name}};
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t times = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++times;
  return times;
}

// What the browser reads as markup: the page without the contents of its script and style elements.
std::string markup(std::string page) {
  for (const std::string element : {"script", "style"})
    for (auto from = page.find('<' + element); from != std::string::npos; from = page.find('<' + element, from + 1)) {
      const auto content = page.find('>', from) + 1;
      page.erase(content, page.find("</" + element + '>', content) - content);
    }
  return page;
}

TEST(Page, ShowsFactsTablesNotesAndCommand) {
  const std::string text = html({.title = "Run",
                                 .summary = "A short one.",
                                 .command = "mote run  ungm --seed 1",
                                 .facts = {{"particles", "1000"}},
                                 .tables = {{"Errors", {"state", "rmse"}, {{"x", "4.2"}, {"y", ""}}}},
                                 .notes = {"Seeds are fixed."}});
  EXPECT_NE(text.find("<title>Run</title>"), std::string::npos);
  EXPECT_NE(text.find("<h1>Run</h1>"), std::string::npos);
  EXPECT_NE(text.find("A short one."), std::string::npos);
  EXPECT_NE(text.find("<dt>particles</dt><dd>1000</dd>"), std::string::npos);
  EXPECT_NE(text.find("<tr><td>x</td><td class=\"number\">4.2</td></tr>"), std::string::npos);
  EXPECT_NE(text.find("<li>Seeds are fixed.</li>"), std::string::npos);
  EXPECT_NE(text.find("<pre><code>mote run  ungm <span>--seed</span> 1</code></pre>"), std::string::npos);
  EXPECT_NE(text.find("<footer>mote " MOTE_VERSION "</footer>"), std::string::npos);
}

TEST(Page, PicturesAreInside) {
  for (const auto& [bytes, letters] : std::vector<std::pair<std::string, std::string>>{
           {"", ""}, {"f", "Zg=="}, {"fo", "Zm8="}, {"foo", "Zm9v"}, {"foob", "Zm9vYg=="}, {"\xFF\xFE\xFD", "//79"}})
    EXPECT_EQ(base64(bytes), letters);
  const std::string text =
      html({.title = "Run", .pictures = {{"Frames \"1\"", "\x89PNG"}, {"Frame 2", "\xFF\xD8\xFF"}}});
  EXPECT_NE(text.find("<figcaption>Frames &quot;1&quot;</figcaption><img alt=\"Frames &quot;1&quot;\" "
                      "src=\"data:image/png;base64,iVBORw==\">"),
            std::string::npos);
  EXPECT_NE(text.find("src=\"data:image/jpeg;base64,/9j/\""), std::string::npos);
  EXPECT_EQ(html({.title = "Run"}).find("<img"), std::string::npos);
}

TEST(Page, EscapesEveryText) {
  EXPECT_EQ(escaped(kNasty), kNastyEscaped);
  const std::string text = html(full_page(kNasty));
  EXPECT_EQ(count(text, "alert('x')</script>"), 0U);
  const std::size_t scripts = plots_built_in() ? 3 : 0;
  EXPECT_EQ(count(text, "<script"), scripts);
  EXPECT_EQ(count(text, "</script"), scripts);
  EXPECT_GE(count(markup(text), kNastyEscaped), 8U);
}

TEST(Page, LoadsNothing) {
  const std::string text = markup(html(full_page("name")));
  for (const char* part :
       {"src=", "href=", "srcset=", "action=", " data=", "<link", "<iframe", "<object", "http:", "https:", "url("})
    EXPECT_EQ(text.find(part), std::string::npos) << part;
  EXPECT_EQ(style_text().find("url("), std::string_view::npos);
  EXPECT_EQ(style_text().find("@import"), std::string_view::npos);
  EXPECT_NE(text.find("default-src 'none'"), std::string::npos);
}

TEST(Page, EmbedsScriptsThatCannotEndTheirElement) {
  for (const std::string_view script : {guard_text(), script_text()}) {
    EXPECT_EQ(script.find("</script"), std::string_view::npos);
    EXPECT_EQ(script.find("<!--"), std::string_view::npos);
  }
}

TEST(Page, PlacesEveryChartOrSaysThatThereAreNone) {
  Page page = full_page("name");
  page.charts.push_back({.title = "Empty"});
  const std::string text = html(page);
  EXPECT_EQ(text.find("data-chart=\"Empty\"") != std::string::npos, plots_built_in());
  EXPECT_EQ(count(text, "<figure"), plots_built_in() ? 2U : 0U);
  EXPECT_EQ(text.find("built without them") != std::string::npos, !plots_built_in());
}

TEST(Page, LeavesOutWhatIsEmpty) {
  const std::string text = markup(html({.title = "Nothing"}));
  for (const char* part : {"<h2", "<figure", "<table", "<pre", "<ul", "<dl", "class=\"summary\""})
    EXPECT_EQ(text.find(part), std::string::npos) << part;
}

TEST(Page, RefusesRaggedTablesAndSeries) {
  Page page = full_page("name");
  page.tables[0].rows.push_back({"one cell"});
  try {
    html(page);
    FAIL() << "accepted a row with one cell in a table of two columns";
  } catch (const std::invalid_argument& refusal) {
    EXPECT_STREQ(refusal.what(),
                 "report page: table \"name\": expected 2 cells in every row, one per column, got 1. "
                 "Write an empty cell where there is no value.");
  }
  page = full_page("name");
  page.charts[0].series[0].y.clear();
  EXPECT_THROW(html(page), std::invalid_argument);
}

}  // namespace
}  // namespace mote::report
