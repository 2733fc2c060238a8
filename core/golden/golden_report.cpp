#include "core/golden/golden_report.h"

#include <algorithm>
#include <fmt/format.h>

#include "core/base/error.h"

namespace hybridrt {
namespace {

namespace fs = std::filesystem;

// --cut: how much of the actual picture, from the left, makes place for the expected one.
constexpr const char* kStyle = R"(
:root{color-scheme:light dark}
body{font:16px/1.45 system-ui,sans-serif;margin:0 auto;padding:1rem;max-width:70rem}
section{border-left:.4rem solid;padding:0 0 0 1rem;margin:2rem 0}
.failed,.broken{border-color:#d55e00}.passed{border-color:#009e73}
h2{margin:0}h2 small{font-weight:normal}
p{margin:.4rem 0;overflow-wrap:anywhere}
code{font-size:.85rem}
.pictures{display:flex;flex-wrap:wrap;gap:1rem}
figure{margin:0;flex:1 1 18rem;min-width:0;max-width:32rem}
figcaption{font-size:.85rem}
img{display:block;width:100%;image-rendering:pixelated}
.both{display:grid;--cut:50%}
.both>*{grid-area:1/1}
.both img+img{clip-path:inset(0 0 0 var(--cut))}
input{width:100%;margin:.3rem 0}
)";

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

/// A file's name as an address in a page of its folder.
std::string address_of(const fs::path& picture) {
  std::string out;
  for (const char c : picture.filename().string()) {
    const bool is_plain =
        (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '-' || c == '_' || c == '.';
    out += is_plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return out;
}

std::string image(const fs::path& picture, const std::string& what) {
  return fmt::format("<img src=\"./{}\" alt=\"{}\">", address_of(picture), escaped(what));
}

std::string pictures_of(const GoldenResult& r) {
  std::string out;
  if (!r.expected.empty() && !r.actual.empty() && !r.passed() && r.compared.measured)
    out += fmt::format(
        "<figure><div class=\"both\">{}{}</div><input type=\"range\" value=\"50\" aria-label=\"from expected to "
        "actual\" "
        "oninput=\"this.previousElementSibling.style.setProperty('--cut',this.value+'%')\">"
        "<figcaption>left of the slider expected, right of it actual</figcaption></figure>\n",
        image(r.expected, r.name + ", expected"), image(r.actual, r.name + ", actual"));
  else
    for (const auto& [picture, what] : {std::pair(r.expected, "expected"), {r.actual, "actual"}})
      if (!picture.empty())
        out +=
            fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n", image(picture, r.name + ", " + what), what);
  if (!r.difference.empty())
    out += fmt::format("<figure>{}<figcaption>difference, amplified</figcaption></figure>\n",
                       image(r.difference, r.name + ", difference"));
  return out.empty() ? out : "<div class=\"pictures\">\n" + out + "</div>\n";
}

std::string time_text(const GoldenTime& time) {
  std::string text = fmt::format("{:.1f} s", time.seconds);
  if (time.budget) text += fmt::format(", {:.1f} of {:g} times the calibration", time.calibrations, *time.budget);
  return text;
}

std::string section(const GoldenResult& r) {
  const char* const state = r.is_broken ? "broken" : r.passed() ? "passed" : "failed";
  std::string out = fmt::format("<section class=\"{0}\"><h2>{1} <small>{0}</small></h2>\n<p>{2}</p>\n", state,
                                escaped(r.name), escaped(r.verdict()));
  out += pictures_of(r);
  return out +
         fmt::format("<p><code>hybridrt render {}</code></p>\n<p>{}{}; limits {:g}, {:g} %, {:g}: {}</p></section>\n",
                     escaped(r.command), r.where.empty() ? "" : escaped(r.where) + "; ", time_text(r.time),
                     r.limits.fail, r.limits.fail_percent, r.limits.hard_fail, escaped(r.reason));
}

int64_t count_failed(std::span<const GoldenResult> results) {
  return std::ranges::count_if(results, [](const GoldenResult& r) { return !r.passed(); });
}

}  // namespace

std::string golden_html(std::span<const GoldenResult> results, const std::string& program) {
  const int64_t failed = count_failed(results), passed = static_cast<int64_t>(results.size()) - failed;
  std::string page = fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n"
      "<title>Golden images: {0} failed</title>\n<style>{1}</style>\n"
      "<main>\n<h1>Golden images: {0} failed, {2} passed</h1>\n<p>{3}</p>\n",
      failed, kStyle, passed, escaped(program));
  for (const bool passing : {false, true})
    for (const GoldenResult& result : results)
      if (result.passed() == passing) page += section(result);
  return page + "</main>\n</html>\n";
}

std::string golden_junit(std::span<const GoldenResult> results) {
  const auto errors = std::ranges::count_if(results, [](const GoldenResult& r) { return r.is_broken; });
  std::string xml = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<testsuite name=\"golden\" tests=\"{}\" failures=\"{}\" errors=\"{}\">\n",
      results.size(), count_failed(results) - errors, errors);
  for (const GoldenResult& r : results) {
    xml += fmt::format("  <testcase classname=\"golden\" name=\"{}\" time=\"{:.3f}\"", escaped(r.name), r.time.seconds);
    xml += r.passed() ? "/>\n"
                      : fmt::format("><{0} message=\"{1}\"/></testcase>\n", r.is_broken ? "error" : "failure",
                                    escaped(r.verdict()));
  }
  return xml + "</testsuite>\n";
}

}  // namespace hybridrt
