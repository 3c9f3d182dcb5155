#include "audit/stability/gallery_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "audit/audit_pictures.h"
#include "audit/stability/gallery_text.h"
#include "core/atomic_file.h"
#include "image/image_files.h"
#include "report/bitmap_font.h"
#include "report/html_page.h"

namespace plumb::audit::stability {
namespace {

constexpr int kGap_px = 4, kCaption_px = 2 * report::kTextLineHeight + 4;
constexpr report::Rgb kPaper{255, 255, 255}, kInk{40, 40, 40};

struct Panel {
  const image::Rgb8Image* picture;
  std::string title, line;
};

// Sixteen steps of each colour: a third of the bytes, and nothing that is looked for is lost.
std::uint8_t coarse(std::uint8_t value) {
  return static_cast<std::uint8_t>((value + 8 > 255 ? 255 : value + 8) / 17 * 17);
}

void put(report::RgbImage& page, const Panel& panel, int x0) {
  const image::Rgb8Image& picture = *panel.picture;
  for (int y = 0; y < picture.height_px; ++y) {
    for (int x = 0; x < picture.width_px; ++x) {
      const std::size_t k = 3 * (static_cast<std::size_t>(y) * picture.width_px + x);
      page.set(x0 + x, y,
               {coarse(picture.rgb[k]), coarse(picture.rgb[k + 1]), coarse(picture.rgb[k + 2])});
    }
  }
  report::draw_text(page, x0, picture.height_px + 3, panel.title, kInk);
  report::draw_text(page, x0, picture.height_px + 3 + report::kTextLineHeight, panel.line, kInk);
}

std::string scale_text(const SceneRun& run) {
  const bool of_colours =
      run.expected_conservative && run.expected_conservative->reading == Reading::ColourError;
  return of_colours ? "colours apart, times 4"
                    : fmt::format("yellow: {:g} px", error_scale_px(run.scene->tolerance));
}

std::vector<Panel> panels_of(const SceneRun& run) {
  std::vector<Panel> panels;
  const auto line = [&](const VariantRun& variant, const Expected& expected) {
    return fmt::format("{}, {}", number_text(run, expected, variant.measured),
                       name_of(variant.verdict));
  };
  const auto is_drawn = [](const std::optional<VariantRun>& variant) {
    return variant && !variant->drawn.rgb.empty();
  };
  if (is_drawn(run.published))
    panels.push_back({&run.published->drawn, run.scene->as_printed ? "as printed" : "published",
                      line(*run.published, *run.expected_published)});
  if (is_drawn(run.conservative))
    panels.push_back({&run.conservative->drawn, "conservative",
                      line(*run.conservative, *run.expected_conservative)});
  if (panels.empty()) return panels;
  const bool of_published = is_drawn(run.published);
  panels.push_back({of_published ? &run.published->error : &run.conservative->error,
                    of_published ? "error of the first" : "error of it", scale_text(run)});
  return panels;
}

std::vector<std::uint8_t> bytes_of(const image::Rgb8Image& picture) {
  const std::string png = image::png_bytes(picture);
  return {png.begin(), png.end()};
}

// What a chapter says before its scenes, and what no scene of it shows.
const char* kOfSlicing =
    "[Röttger & Ertl 2001]. Slices alone, so that polygons hide nothing; the claim is a pixel of "
    "error. Not shown by a scene: errata of the printed figures and of the cost formula, which "
    "change the cost and not the picture; the paper's texture and mesh of different sizes, since "
    "ours read the same samples.";
const char* kOfTessellation =
    "[Yusov & Shevtsov 2011]. Not shown by a scene: misprints of indices and of the matrix's size, "
    "which nobody can draw.";
const char* kOfQuadtrees =
    "[Intel sample 2012; Pajarola 1998; Lindstrom et al. 1996]. The method has no published "
    "variant "
    "here: under `published` stand the printed rules of one patch without its flanges, drawn for "
    "this gallery alone, where there is such a column. Not shown by a scene: the order of "
    "children, which changes the bits of a file and not the mesh.";
const char* kOfStacks =
    "[Löffler, Müller & Schumann 2011]. The published tolerance is the size of a node, and nothing "
    "is claimed of errors; coverage is claimed of everything that is drawn. Not shown by a scene, "
    "as the library does not do it: replaced densities without the vertices, nodes of 17 samples, "
    "normals with the wrong sign, trees out of balance.";

// What methods with a chapter are called there.
struct Chapter {
  const char* heading;
  std::vector<std::string> methods;
  const char* note;
};
const std::vector<Chapter>& chapters() {
  static const std::vector<Chapter> kChapters{
      {"Slicing", {"slicing", "hybrid-slicing"}, kOfSlicing},
      {"Tessellation and chunks", {"tessellation", "chunked"}, kOfTessellation},
      {"Restricted quadtree", {"restricted-quadtree"}, kOfQuadtrees},
      {"Stacks of material", {"stacks"}, kOfStacks}};
  return kChapters;
}

std::string row_of(const SceneRun& run) {
  return fmt::format("| {} | {} | {} | {} | {} |\n", run.scene->name, run.method,
                     measured_text(run, run.published, run.expected_published),
                     claimed_text(run, run.conservative, run.expected_conservative),
                     measured_text(run, run.conservative, run.expected_conservative));
}

const char* kTableHead =
    "| scene | method | published | conservative claims | conservative |\n"
    "| --- | --- | --- | --- | --- |\n";

std::string tolerance_text(const Scene& scene) {
  std::string text = "Tolerance " + to_text(scene.tolerance);
  if (scene.size) text += fmt::format(" ({} of a node, as published)", to_text(*scene.size));
  for (const auto& [name, value] : scene.parameters) text += fmt::format(", {}={}", name, value);
  return text + ".";
}

std::string section_of(const SceneRun& run) {
  std::string text = fmt::format("### {}\n\n{}", run.scene->name, run.scene->fails);
  if (!run.scene->finding.empty()) text += " *" + run.scene->finding + "*";
  text += " " + tolerance_text(*run.scene) + "\n\n";
  const std::string figure = figure_name(run);
  if (!figure.empty()) text += fmt::format("![{}]({})\n\n", run.scene->name, figure);
  return text;
}

std::string chapter_text(const Chapter& chapter, const std::vector<SceneRun>& runs) {
  std::string rows, sections;
  const Scene* last = nullptr;
  for (const SceneRun& run : runs) {
    const auto& methods = chapter.methods;
    if (run.scene->is_degenerate ||
        std::find(methods.begin(), methods.end(), run.scene->methods.front()) == methods.end())
      continue;
    rows += row_of(run);
    if (run.scene != last) sections += section_of(run);
    last = run.scene;
  }
  if (rows.empty()) return "";
  return fmt::format("## {}\n\n{}\n\n{}{}\n{}", chapter.heading, chapter.note, kTableHead, rows,
                     sections);
}

std::string degenerate_text(const std::vector<SceneRun>& runs) {
  std::string rows, lines;
  const Scene* last = nullptr;
  for (const SceneRun& run : runs) {
    if (!run.scene->is_degenerate) continue;
    rows += row_of(run);
    if (run.scene == last) continue;
    last = run.scene;
    lines += fmt::format("* **{}**: {}{}\n", run.scene->name, run.scene->fails,
                         run.scene->finding.empty() ? "" : " *" + run.scene->finding + "*");
  }
  if (rows.empty()) return "";
  return fmt::format(
      "## Input that is hardly any\n\nEvery method draws it with claims that hold, or refuses it "
      "in one line; \"none\" where nothing of the terrain can be judged.\n\n{}\n{}{}",
      lines, kTableHead, rows);
}

report::Table html_table(const std::vector<SceneRun>& runs) {
  report::Table table{"What was measured",
                      {{"scene"},
                       {"method"},
                       {"published"},
                       {"conservative claims"},
                       {"conservative"},
                       {"as expected"}},
                      {}};
  for (const SceneRun& run : runs) {
    table.rows.push_back(
        {{run.scene->name, run.method, measured_text(run, run.published, run.expected_published),
          claimed_text(run, run.conservative, run.expected_conservative),
          measured_text(run, run.conservative, run.expected_conservative),
          run.is_as_expected() ? "yes" : "NO"},
         run.is_as_expected() ? report::RowKind::Ok : report::RowKind::Bad});
  }
  return table;
}

std::string html_of(const std::vector<SceneRun>& runs) {
  report::HtmlPage page("Where methods fail");
  const bool all = std::all_of(runs.begin(), runs.end(),
                               [](const SceneRun& run) { return run.is_as_expected(); });
  page.add_verdict(all ? report::Verdict::Passes : report::Verdict::Fails, summary_text(runs));
  page.add_table(html_table(runs));
  for (const SceneRun& run : runs) {
    if (figure_name(run).empty()) continue;
    const image::Rgb8Image picture = scene_picture(run);
    page.add_heading(run.scene->name + ", " + run.method);
    page.add_paragraph(run.scene->fails);
    if (!run.scene->finding.empty()) page.add_paragraph(run.scene->finding);
    page.add_picture(tolerance_text(*run.scene), bytes_of(picture));
  }
  return page.text();
}

}  // namespace

image::Rgb8Image scene_picture(const SceneRun& run) {
  const std::vector<Panel> panels = panels_of(run);
  if (panels.empty()) return {};
  const int width = panels.front().picture->width_px, height = panels.front().picture->height_px;
  const auto count = static_cast<int>(panels.size());
  report::RgbImage page(count * width + (count - 1) * kGap_px, height + kCaption_px, kPaper);
  for (int k = 0; k < count; ++k)
    put(page, panels[static_cast<std::size_t>(k)], k * (width + kGap_px));
  return rgb8_of(std::move(page));
}

std::string figure_name(const SceneRun& run) {
  const auto is_drawn = [](const std::optional<VariantRun>& variant) {
    return variant && variant->refused.empty() && variant->verdict != Verdict::None;
  };
  if (run.scene->is_degenerate || (!is_drawn(run.published) && !is_drawn(run.conservative)))
    return "";
  const std::string suffix = run.scene->methods.size() > 1 ? "-" + run.method : "";
  return "figures/failures/" + run.scene->name + suffix + ".png";
}

std::string gallery_markdown(const std::vector<SceneRun>& runs) {
  std::string text =
      "# Where methods fail\n\n"
      "Scenes in which the rules of the papers break, each with what is measured there: by the "
      "published rules, and by the conservative ones, which keep what they claim (but where "
      "a budget makes them lag behind: levels-two-apart-after-a-jump). Where a claim other than "
      "that of the number decides the verdict, it is named. `plumb "
      "stability` draws and audits all of them and holds what it measures against what is stated "
      "in `src/audit/stability`; `plumb stability NAME -o FOLDER` makes these pictures: "
      "published, conservative, and the error of the first, yellow at "
      "the tolerance (at a pixel where that is in metres) and red beyond it, with holes red, "
      "overshoots magenta and see-through cracks orange.\n\n"
      "This page is made by `plumb stability -o FOLDER`; a test compares its text with what the "
      "program makes.\n\n";
  for (const Chapter& chapter : chapters()) text += chapter_text(chapter, runs);
  return text + degenerate_text(runs);
}

std::vector<std::string> write_gallery_page(const std::filesystem::path& folder,
                                            const std::vector<SceneRun>& runs) {
  make_folder(folder / "figures" / "failures");
  std::vector<std::string> files;
  for (const SceneRun& run : runs) {
    const std::string name = figure_name(run);
    if (name.empty()) continue;
    image::write_png(folder / name, scene_picture(run));
    files.push_back(name);
  }
  write_file_atomically(folder / "failures.md", gallery_markdown(runs));
  write_file_atomically(folder / "failures.html", html_of(runs));
  files.insert(files.end(), {"failures.md", "failures.html"});
  return files;
}

}  // namespace plumb::audit::stability
