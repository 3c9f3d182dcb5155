#include "compare/comparison_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <system_error>
#include <utility>

#include "compare/comparison_json.h"
#include "compare/comparison_pictures.h"
#include "compare/comparison_tables.h"
#include "compare/comparison_words.h"
#include "core/atomic_file.h"
#include "core/check.h"
#include "core/parallel.h"
#include "image/image_files.h"
#include "report/histogram_chart.h"
#include "report/html_page.h"

namespace plumb::compare {
namespace {

namespace fs = std::filesystem;

constexpr const char* kViewerId = "pictures";
constexpr int kHistogramBins = 64;

std::vector<std::uint8_t> png_of(const image::Rgb8Image& picture) {
  if (picture.rgb.empty()) return {};
  const std::string bytes = image::png_bytes(picture);
  return {bytes.begin(), bytes.end()};
}

// Writes the pictures and gives those of the page; compressing them is most of a report's time.
report::Viewer write_pictures(const fs::path& folder, const std::vector<ReportPicture>& pictures,
                              const PicturePair& pair) {
  std::vector<report::ViewerImage> images(pictures.size());
  parallel_for(static_cast<std::int64_t>(pictures.size()), 1, [&](std::int64_t at) {
    const ReportPicture& shown = pictures[static_cast<std::size_t>(at)];
    const std::vector<std::uint8_t> png = png_of(shown.picture);
    if (shown.legend.rgb.empty()) {
      write_file_atomically(folder / shown.file,
                            {reinterpret_cast<const char*>(png.data()), png.size()});
    } else {
      image::write_png(folder / shown.file, stacked(shown.picture, shown.legend));
    }
    images[static_cast<std::size_t>(at)] = {shown.name, shown.note, png, png_of(shown.legend)};
  });
  return {kViewerId, "Reference, candidate and differences", pair.width_px(), pair.height_px(),
          std::move(images)};
}

std::string histogram_caption(const ErrorMap& map, const report::Histogram& histogram) {
  std::string text = fmt::format("{}: {}; left out: {} pixels without a difference", map.name,
                                 map.meaning, histogram.zero);
  if (histogram.infinite > 0) text += fmt::format(", {} infinite ones", histogram.infinite);
  if (histogram.no_value > 0) text += fmt::format(", {} without a value", histogram.no_value);
  return text + ".";
}

void add_histograms(report::HtmlPage& page, const Comparison& comparison) {
  if (comparison.maps.empty()) return;
  page.add_heading("How often each difference occurs");
  std::vector<std::string> without;
  for (const ErrorMap& map : comparison.maps) {
    if (is_kind_map(map)) continue;
    const report::Histogram histogram = report::histogram_of(map.values, kHistogramBins);
    if (std::all_of(histogram.counts.begin(), histogram.counts.end(),
                    [](std::int64_t count) { return count == 0; })) {
      without.push_back(map.name);
      continue;
    }
    const std::string label = map.unit.empty() ? map.name : map.name + ", " + map.unit;
    page.add_chart(histogram_caption(map, histogram),
                   report::to_svg({map.name, label, map.unit, histogram, map.limit}));
  }
  if (!without.empty())
    page.add_paragraph(
        fmt::format("Without a finite difference above zero: {}.", fmt::join(without, ", ")));
}

std::string page_of(const Comparison& comparison, const report::Viewer& viewer,
                    const std::string& command, const std::string& json) {
  report::HtmlPage page(
      fmt::format("{} compared with {}", comparison.candidate_name, comparison.reference_name));
  page.add_verdict(banner_of(comparison.verdict), verdict_sentence(comparison));
  page.add_list("Why", comparison.reasons);
  if (!comparison.systematic.empty()) page.add_table(systematic_table(comparison));
  page.add_list("Notes", comparison.notes);
  page.add_table(limits_table(comparison));
  page.add_viewer(viewer);
  if (!comparison.worst.empty()) page.add_offenders(worst_list(comparison, kViewerId));
  add_histograms(page, comparison);
  page.add_heading("Measurements");
  page.add_table(measurements_table(comparison));
  if (const report::Table channels = channels_table(comparison); !channels.rows.empty())
    page.add_table(channels);
  page.add_key_values("Coverage, numbers and mask", shape_entries(comparison));
  page.add_key_values("What was compared", subject_entries(comparison, command));
  page.add_details("JSON of this comparison", json);
  return page.text();
}

}  // namespace

std::vector<std::string> write_comparison(const fs::path& folder, const PicturePair& pair,
                                          const Comparison& comparison,
                                          const std::string& command) {
  make_folder(folder);
  const std::vector<ReportPicture> pictures = comparison_pictures(pair, comparison);
  const report::Viewer viewer = write_pictures(folder, pictures, pair);
  const std::string json = comparison_json(comparison, command);
  write_file_atomically(folder / "comparison.json", json);
  write_file_atomically(folder / "index.html", page_of(comparison, viewer, command, json));
  std::vector<std::string> files{"index.html", "comparison.json"};
  for (const ReportPicture& picture : pictures) files.push_back(picture.file);
  return files;
}

FolderPair write_folder_pair(const fs::path& folder, const std::string& name,
                             const PicturePair& pair, Comparison comparison,
                             const std::string& command) {
  const fs::path below = fs::path(name).lexically_normal();
  require(!below.empty() && !below.is_absolute() && *below.begin() != "..",
          "a pair's name must lie below its folder, got '{}'", name);
  write_comparison(folder / "pairs" / below, pair, comparison, command);
  FolderPair written{
      name, std::move(comparison), (fs::path("pairs") / below / "index.html").generic_string(), {}};
  written.thumbnail_png = thumbnail_png(pair, written.comparison);
  written.comparison.maps.clear();
  return written;
}

}  // namespace plumb::compare
