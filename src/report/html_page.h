// A report as one HTML file that needs nothing else: no network, no other file, no script to be
// read.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace plumb::report {

enum class Verdict { Held, Broken, MeasuredOnly, None, Equal, Passes, Fails };

struct KeyValue {
  std::string key;
  std::string value;
};

struct Column {
  std::string name;
  bool numeric = false;  // set flush right
  bool wide = false;     // of sentences: has room for a few words however narrow the window is
};

enum class RowKind { Plain, Ok, Bad };

struct Row {
  std::vector<std::string> cells;  // as many as there are columns
  RowKind kind = RowKind::Plain;
};

struct Table {
  std::string caption;
  std::vector<Column> columns;
  std::vector<Row> rows;
  bool folded = false;  // its caption alone until somebody asks
};

/// A picture of a viewer.
struct ViewerImage {
  std::string name;                      // short: "truth", "drawn"
  std::string note;                      // one sentence; may be empty
  std::vector<std::uint8_t> png;         // the bytes of a PNG file
  std::vector<std::uint8_t> legend_png;  // shown below it; may be empty
};

/// Pictures of one size, to be looked at side by side, wiped, blinked and subtracted.
struct Viewer {
  std::string id;  // letters, digits and hyphens; an address within the page
  std::string caption;
  int width_px = 0;  // of every picture
  int height_px = 0;
  std::vector<ViewerImage> images;
};

/// A place worth looking at.
struct Offender {
  int x_px = 0;  // pixel of the viewer's pictures, from the top left; below 0: out of view
  int y_px = 0;
  std::vector<std::string> cells;
};

/// A list of places; each that is in view jumps to its pixel in a viewer and marks it there.
struct OffenderList {
  std::string caption;
  std::string viewer_id;
  std::vector<Column> columns;  // of the cells; rank and pixel go before them
  std::vector<Offender> offenders;
};

/// A row that leads to a page of its own, with a small picture.
struct LinkRow {
  std::string name;
  std::string address;                      // '/' between folders, from this page's own; "": none
  std::vector<std::uint8_t> thumbnail_png;  // may be empty
  std::vector<std::string> cells;
  RowKind kind = RowKind::Plain;
};

/// A table of other pages; picture (if a row has one) and name go before the cells.
struct LinkTable {
  std::string caption;
  std::string name_column;
  std::vector<Column> columns;
  std::vector<LinkRow> rows;
};

/// A picture that stands among others.
struct CaptionedPicture {
  std::string caption;
  std::vector<std::uint8_t> png;  // the bytes of a PNG file
};

/// Charts that a drawing library makes of one table while the page is open.
struct LiveCharts {
  std::string table_json;      // what web/chart-data.js reads
  std::string templates_json;  // an object: a chart's name and its Vega specification
  std::string library;         // the text of vega.min.js
};

/// Text as HTML shows it: & < > " ' replaced by references, control characters (but line ends and
/// tabs) by U+FFFD. The input is UTF-8.
std::string escape_html(std::string_view text);

/// Builds the page from top to bottom. Every text is escaped; none is taken as HTML.
class HtmlPage {
 public:
  explicit HtmlPage(std::string_view title);

  void add_verdict(Verdict verdict, std::string_view sentence);
  void add_heading(std::string_view text);
  void add_paragraph(std::string_view text);
  /// One line each, with a dot before it; nothing where there is none.
  void add_list(std::string_view caption, const std::vector<std::string>& lines);
  void add_key_values(std::string_view caption, const std::vector<KeyValue>& entries);
  /// Throws std::invalid_argument if a row has not as many cells as there are columns.
  void add_table(const Table& table);
  /// Throws std::invalid_argument if the id is not an address, the size not positive, a picture has
  /// no bytes or is not a PNG of the stated size.
  void add_viewer(const Viewer& viewer);
  /// Throws std::invalid_argument if a row has not as many cells as there are columns, or the
  /// viewer_id is not an address.
  void add_offenders(const OffenderList& list);
  /// One picture by itself (a chart, say). Throws std::invalid_argument if it is no PNG.
  void add_picture(std::string_view caption, const std::vector<std::uint8_t>& png);
  /// Pictures side by side, as far as there is room. Throws as above.
  void add_pictures(std::string_view caption, const std::vector<CaptionedPicture>& pictures);
  /// A chart drawn as SVG. Throws std::invalid_argument if it does not begin as one.
  void add_chart(std::string_view caption, std::string_view svg);
  /// Throws std::invalid_argument if a row has not as many cells as there are columns, a picture is
  /// no PNG, or an address is absolute.
  void add_links(const LinkTable& table);
  /// What draws the charts, once a page; their controls stand here. Throws std::invalid_argument if
  /// there was one before, or the library has a text that ends a script.
  void set_live_charts(LiveCharts charts);
  /// The place of one of them. Throws std::invalid_argument unless the name is an id.
  void add_live_chart(std::string_view name, std::string_view label);
  /// Text that is there on request: the JSON of the run.
  void add_details(std::string_view summary, std::string_view text);

  /// The whole page, UTF-8.
  std::string text() const;

 private:
  std::string title_;
  std::string body_;
  std::optional<LiveCharts> live_;
};

}  // namespace plumb::report
