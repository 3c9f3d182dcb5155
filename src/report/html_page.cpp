#include "report/html_page.h"

#include <fmt/format.h>

#include "core/check.h"
#include "report/html_parts.h"
#include "report/web_assets.h"

namespace plumb::report {
namespace {

struct VerdictWords {
  const char* kind;   // the banner's class
  const char* label;  // says it without colour
};

VerdictWords words_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::Held:
      return {"held", "Held"};
    case Verdict::Broken:
      return {"broken", "Broken"};
    case Verdict::MeasuredOnly:
      return {"measured", "Measured only"};
    case Verdict::None:
      return {"measured", "No verdict"};
    case Verdict::Equal:
      return {"held", "Equal"};
    case Verdict::Passes:
      return {"held", "Passes"};
    case Verdict::Fails:
      return {"broken", "Fails"};
  }
  return {"measured", "?"};
}

// What a browser may load: nothing but what stands in the page. The drawing library of live charts
// compiles the expressions of their templates.
constexpr std::string_view kPolicy =
    "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'";
constexpr std::string_view kMayCompile = " 'unsafe-eval'";

}  // namespace

std::string escape_html(std::string_view text) {
  std::string escaped;
  escaped.reserve(text.size());
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&#39;";
        break;
      default: {
        const auto byte = static_cast<unsigned char>(c);
        const bool control = (byte < 0x20 && c != '\n' && c != '\t' && c != '\r') || byte == 0x7f;
        if (control) {
          escaped += "\xEF\xBF\xBD";
        } else {
          escaped += c;
        }
      }
    }
  }
  return escaped;
}

namespace {

const char* class_of(const Column& column) {
  return column.numeric ? " class=\"number\"" : column.wide ? " class=\"wide\"" : "";
}

}  // namespace

std::string header_cells(const std::vector<Column>& columns) {
  std::string html;
  for (const Column& column : columns) {
    html += fmt::format("<th scope=\"col\"{}>{}</th>", class_of(column), escape_html(column.name));
  }
  return html;
}

std::string body_cells(const std::vector<Column>& columns, const std::vector<std::string>& cells) {
  require(cells.size() == columns.size(), "a row needs {} cells, got {}", columns.size(),
          cells.size());
  std::string html;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    html += fmt::format("<td{}>{}</td>", class_of(columns[i]), escape_html(cells[i]));
  }
  return html;
}

const char* row_class(RowKind kind) {
  return kind == RowKind::Ok ? " class=\"ok\"" : kind == RowKind::Bad ? " class=\"bad\"" : "";
}

HtmlPage::HtmlPage(std::string_view title) : title_(escape_html(title)) {}

void HtmlPage::add_verdict(Verdict verdict, std::string_view sentence) {
  const VerdictWords words = words_of(verdict);
  body_ += fmt::format("<p class=\"verdict {}\"><strong>{}</strong> <span>{}</span></p>\n",
                       words.kind, words.label, escape_html(sentence));
}

void HtmlPage::add_heading(std::string_view text) {
  body_ += fmt::format("<h2>{}</h2>\n", escape_html(text));
}

void HtmlPage::add_paragraph(std::string_view text) {
  body_ += fmt::format("<p>{}</p>\n", escape_html(text));
}

void HtmlPage::add_list(std::string_view caption, const std::vector<std::string>& lines) {
  if (lines.empty()) return;
  body_ += fmt::format("<h3>{}</h3>\n<ul>\n", escape_html(caption));
  for (const std::string& line : lines) body_ += fmt::format("<li>{}</li>\n", escape_html(line));
  body_ += "</ul>\n";
}

void HtmlPage::add_key_values(std::string_view caption, const std::vector<KeyValue>& entries) {
  body_ +=
      fmt::format("<table class=\"facts\"><caption>{}</caption><tbody>\n", escape_html(caption));
  for (const KeyValue& entry : entries) {
    body_ += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n", escape_html(entry.key),
                         escape_html(entry.value));
  }
  body_ += "</tbody></table>\n";
}

void HtmlPage::add_table(const Table& table) {
  const std::string caption = escape_html(table.caption);
  std::string html = table.folded ? fmt::format("<details><summary>{}</summary>", caption) : "";
  html += fmt::format("<div class=\"scroll\"><table>{}<thead><tr>{}</tr></thead><tbody>\n",
                      table.folded ? "" : fmt::format("<caption>{}</caption>", caption),
                      header_cells(table.columns));
  for (const Row& row : table.rows) {
    html +=
        fmt::format("<tr{}>{}</tr>\n", row_class(row.kind), body_cells(table.columns, row.cells));
  }
  body_ += html + "</tbody></table></div>" + (table.folded ? "</details>\n" : "\n");
}

void HtmlPage::add_details(std::string_view summary, std::string_view text) {
  body_ += fmt::format("<details><summary>{}</summary><pre>{}</pre></details>\n",
                       escape_html(summary), escape_html(text));
}

std::string HtmlPage::text() const {
  std::string page = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" "
      "content=\"{}{}\">\n<title>{}</title>\n<style>\n",
      kPolicy, live_ ? kMayCompile : "", title_);
  page += kReportStyle;
  if (live_) page += kChartStyle;
  page += fmt::format("</style>\n</head>\n<body>\n<main>\n<h1>{}</h1>\n", title_);
  page += body_;
  page += "</main>\n<script>\n";
  page += kReportScript;
  page += "</script>\n";
  if (live_) page += live_scripts(*live_);
  page += "</body>\n</html>\n";
  return page;
}

}  // namespace plumb::report
