#include <algorithm>
#include <fmt/format.h>

#include "core/base/error.h"
#include "core/golden/golden.h"

namespace hybridrt {
namespace {

namespace fs = std::filesystem;

std::string escaped(const std::string& text) {
  std::string out;
  for (char c : in_one_line(text)) {  // XML has no control characters
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

std::string figure(const char* caption, const fs::path& image, const fs::path& page_folder) {
  if (image.empty()) return "";
  const std::string source = escaped(fs::proximate(image, page_folder).generic_string());
  return fmt::format("<figure><a href=\"{0}\"><img src=\"{0}\" alt=\"{1}\"></a><figcaption>{1}</figcaption></figure>\n",
                     source, caption);
}

}  // namespace

std::string golden_html(std::span<const GoldenResult> results, const fs::path& page_folder) {
  const auto failed = std::count_if(results.begin(), results.end(), [](const GoldenResult& r) { return !r.passed(); });
  std::string page = fmt::format(
      "<!doctype html>\n<meta charset=\"utf-8\">\n<title>Golden images: {0} failed</title>\n"
      "<style>body{{font:15px sans-serif;margin:2em;max-width:75em}}figure{{display:inline-block;margin:.3em}}"
      "img{{width:22em;image-rendering:pixelated}}.failed h2{{color:#b00}}.passed h2{{color:#070}}"
      "code{{background:#eee}}</style>\n<h1>Golden images: {1} passed, {0} failed</h1>\n",
      failed, static_cast<long>(results.size()) - failed);
  for (const GoldenResult& result : results) {
    std::string options;
    for (const std::string& option : result.golden.options) options += " " + option;
    page += fmt::format(
        "<section class=\"{0}\"><h2>{1}: {0}</h2>\n<p>{2}</p>\n<p><code>{3}{4}</code><br>"
        "limits {5}, {6} %, {7}: {8}</p>\n",
        result.passed() ? "passed" : "failed", escaped(result.golden.name), escaped(result.verdict()),
        escaped(result.golden.scene), escaped(options), result.golden.limits.fail, result.golden.limits.fail_percent,
        result.golden.limits.hard_fail, escaped(result.golden.reason));
    page += figure("expected", result.expected, page_folder) + figure("actual", result.actual, page_folder) +
            figure("difference, amplified", result.difference, page_folder) + "</section>\n";
  }
  return page;
}

std::string golden_junit(std::span<const GoldenResult> results) {
  const auto failed = std::count_if(results.begin(), results.end(), [](const GoldenResult& r) { return !r.passed(); });
  std::string xml = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<testsuite name=\"golden\" tests=\"{}\" failures=\"{}\">\n",
      results.size(), failed);
  for (const GoldenResult& result : results) {
    xml += fmt::format("  <testcase classname=\"golden\" name=\"{}\" time=\"{:.3f}\"", escaped(result.golden.name),
                       result.seconds);
    xml += result.passed() ? "/>\n" : fmt::format("><failure message=\"{}\"/></testcase>\n", escaped(result.verdict()));
  }
  return xml + "</testsuite>\n";
}

}  // namespace hybridrt
