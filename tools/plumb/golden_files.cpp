// The pictures and reports of golden cases that do not pass, for people to look at.
#include <algorithm>

#include "audit/picture.h"
#include "compare/comparison_page.h"
#include "core/atomic_file.h"
#include "core/check.h"
#include "golden_picture.h"
#include "golden_text.h"
#include "image/image_files.h"

namespace plumb::tool {
namespace fs = std::filesystem;
namespace {

bool lies_in(const fs::path& path, const fs::path& folder) {
  const fs::path inner = fs::weakly_canonical(path / ""), outer = fs::weakly_canonical(folder / "");
  const fs::path from = inner.lexically_relative(outer);
  return !from.empty() && *from.begin() != "..";
}

}  // namespace

void require_place_of_its_own(const GoldenOptions& options) {
  for (const std::string& folder : {options.folder, options.actual}) {
    if (!options.output.empty() && !folder.empty() && lies_in(options.output, folder))
      input_error("-o '{}': it lies in '{}', where nothing but the cases' own files may be",
                  options.output, folder);
  }
}

void write_case_files(const std::string& folder, const std::string& command, GoldenCheck& check) {
  if (!check.has_picture()) return;
  const fs::path place = fs::path(folder) / check.name;
  make_folder(place);
  if (check.drawn) {
    check.files.actual = place / "actual.exr";
    image::write_exr(check.files.actual, *check.drawn);
    image::write_png(place / "actual.png", audit::preview_of(*check.drawn));
  } else {
    const fs::path copy = place / ("actual" + small_extension(check.files.actual));
    copy_whole(check.files.actual, copy);
    check.files.actual = copy;
  }
  if (!check.files.golden.empty()) {
    const fs::path copy = place / ("golden" + small_extension(check.files.golden));
    copy_whole(check.files.golden, copy);
    check.files.golden = copy;
  }
  if (!check.comparison) return;
  const std::vector<std::string> written =
      compare::write_comparison(place, check.pair, *check.comparison, command);
  check.files.page = place / "index.html";
  if (std::find(written.begin(), written.end(), "difference.png") != written.end())
    check.files.difference = place / "difference.png";
}

}  // namespace plumb::tool
