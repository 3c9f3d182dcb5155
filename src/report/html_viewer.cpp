// The parts of a page that show pictures.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/check.h"
#include "report/base64.h"
#include "report/html_page.h"
#include "report/html_parts.h"

namespace plumb::report {
namespace {

// The first bytes of every PNG file: signature, then the header chunk with its length and name.
constexpr std::array<std::uint8_t, 16> kPngStart{0x89, 'P', 'N', 'G', 0x0d, 0x0a, 0x1a, 0x0a,
                                                 0,    0,   0,   13,  'I',  'H',  'D',  'R'};

int big_endian_int(std::span<const std::uint8_t> bytes) {
  return static_cast<int>((unsigned{bytes[0]} << 24) | (unsigned{bytes[1]} << 16) |
                          (unsigned{bytes[2]} << 8) | unsigned{bytes[3]});
}

std::string figure(const Viewer& viewer, const ViewerImage& image) {
  const std::string name = escape_html(image.name);
  std::string html = fmt::format(
      "<figure><img class=\"pixels\" src=\"{}\" width=\"{}\" height=\"{}\" alt=\"{}\" "
      "data-name=\"{}\">",
      png_address(image.png, image.name, viewer.width_px, viewer.height_px), viewer.width_px,
      viewer.height_px, name, name);
  if (!image.legend_png.empty()) {
    html += fmt::format("<img class=\"legend\" src=\"{}\" alt=\"legend of {}\">",
                        png_address(image.legend_png, image.name), name);
  }
  html += fmt::format("<figcaption><strong>{}</strong> {}</figcaption></figure>\n", name,
                      escape_html(image.note));
  return html;
}

// A path as an address: everything that could mean something else in one is encoded.
std::string address_of(std::string_view path) {
  require(!path.starts_with('/'), "an address must be relative, got '{}'", path);
  std::string address;
  for (const char c : path) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       c == '-' || c == '.' || c == '_' || c == '~' || c == '/';
    address += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return address;
}

std::string linked(const std::string& address, const std::string& html) {
  if (address.empty() || html.empty()) return html;
  return fmt::format("<a href=\"{}\">{}</a>", address_of(address), html);
}

std::string pixel_link(const std::string& viewer_id, const Offender& offender) {
  if (offender.x_px < 0 || offender.y_px < 0) return "out of view";
  return fmt::format("<a href=\"#{}\" data-viewer=\"{}\" data-x=\"{}\" data-y=\"{}\">{}, {}</a>",
                     viewer_id, viewer_id, offender.x_px, offender.y_px, offender.x_px,
                     offender.y_px);
}

}  // namespace

std::string png_address(std::span<const std::uint8_t> png, std::string_view name, int width_px,
                        int height_px) {
  require(png.size() > 24 && std::equal(kPngStart.begin(), kPngStart.end(), png.begin()),
          "the picture '{}' is no PNG ({} bytes)", name, png.size());
  const int columns = big_endian_int(png.subspan(16, 4)), rows = big_endian_int(png.subspan(20, 4));
  require(width_px == 0 || (columns == width_px && rows == height_px),
          "the picture '{}' must be {} x {}, got {} x {}", name, width_px, height_px, columns,
          rows);
  return "data:image/png;base64," + base64(png);
}

void require_id(std::string_view id) {
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
  };
  require(!id.empty() && std::all_of(id.begin(), id.end(), allowed),
          "an id is made of letters, digits and hyphens, got '{}'", id);
}

void HtmlPage::add_viewer(const Viewer& viewer) {
  require_id(viewer.id);
  require(viewer.width_px >= 1 && viewer.height_px >= 1,
          "a viewer's pictures need a pixel or more, got {} x {}", viewer.width_px,
          viewer.height_px);
  std::string html = fmt::format(
      "<section class=\"viewer\" id=\"{}\" data-width=\"{}\" data-height=\"{}\" "
      "aria-label=\"{}\">\n<h3>{}</h3>\n<div class=\"figures\">\n",
      viewer.id, viewer.width_px, viewer.height_px, escape_html(viewer.caption),
      escape_html(viewer.caption));
  for (const ViewerImage& image : viewer.images) html += figure(viewer, image);
  body_ += html + "</div>\n</section>\n";
}

void HtmlPage::add_picture(std::string_view caption, const std::vector<std::uint8_t>& png) {
  body_ += fmt::format(
      "<figure class=\"picture\"><img src=\"{}\" alt=\"{}\"><figcaption>{}</figcaption></figure>\n",
      png_address(png, caption), escape_html(caption), escape_html(caption));
}

void HtmlPage::add_chart(std::string_view caption, std::string_view svg) {
  require(svg.starts_with("<svg "), "the chart '{}' is no SVG ({} bytes)", caption, svg.size());
  const std::vector<std::uint8_t> bytes(svg.begin(), svg.end());
  body_ += fmt::format(
      "<figure class=\"chart\"><img src=\"data:image/svg+xml;base64,{}\" alt=\"{}\">"
      "<figcaption>{}</figcaption></figure>\n",
      base64(bytes), escape_html(caption), escape_html(caption));
}

void HtmlPage::add_pictures(std::string_view caption,
                            const std::vector<CaptionedPicture>& pictures) {
  body_ += fmt::format("<h3>{}</h3>\n<div class=\"figures\">\n", escape_html(caption));
  for (const CaptionedPicture& picture : pictures)
    body_ +=
        fmt::format("<figure><img src=\"{}\" alt=\"{}\"><figcaption>{}</figcaption></figure>\n",
                    png_address(picture.png, picture.caption), escape_html(picture.caption),
                    escape_html(picture.caption));
  body_ += "</div>\n";
}

void HtmlPage::add_offenders(const OffenderList& list) {
  require_id(list.viewer_id);
  std::string html = fmt::format(
      "<div class=\"scroll\"><table class=\"offenders\"><caption>{}</caption><thead><tr>"
      "<th scope=\"col\" class=\"number\">#</th><th scope=\"col\" class=\"number\">pixel</th>{}"
      "</tr></thead><tbody>\n",
      escape_html(list.caption), header_cells(list.columns));
  int rank = 0;
  for (const Offender& offender : list.offenders) {
    html +=
        fmt::format("<tr><td class=\"number\">{}</td><td class=\"number\">{}</td>{}</tr>\n", ++rank,
                    pixel_link(list.viewer_id, offender), body_cells(list.columns, offender.cells));
  }
  body_ += html + "</tbody></table></div>\n";
}

void HtmlPage::add_links(const LinkTable& table) {
  const bool pictures = std::any_of(table.rows.begin(), table.rows.end(),
                                    [](const LinkRow& row) { return !row.thumbnail_png.empty(); });
  std::string html = fmt::format(
      "<div class=\"scroll\"><table{}><caption>{}</caption><thead><tr>"
      "{}<th scope=\"col\">{}</th>{}</tr></thead><tbody>\n",
      pictures ? " class=\"links\"" : "", escape_html(table.caption),
      pictures ? "<th scope=\"col\">picture</th>" : "", escape_html(table.name_column),
      header_cells(table.columns));
  for (const LinkRow& row : table.rows) {
    const std::string image =
        row.thumbnail_png.empty()
            ? ""
            : fmt::format("<img src=\"{}\" alt=\"{}\">", png_address(row.thumbnail_png, row.name),
                          escape_html(row.name));
    const std::string picture =
        pictures ? fmt::format("<td>{}</td>", linked(row.address, image)) : "";
    html += fmt::format("<tr{}>{}<td>{}</td>{}</tr>\n", row_class(row.kind), picture,
                        linked(row.address, escape_html(row.name)),
                        body_cells(table.columns, row.cells));
  }
  body_ += html + "</tbody></table></div>\n";
}

}  // namespace plumb::report
