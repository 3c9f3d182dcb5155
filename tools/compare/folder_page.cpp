// The page of two folders.
#include <fmt/format.h>

#include <system_error>

#include "compare/comparison_json.h"
#include "compare/comparison_page.h"
#include "compare/comparison_tables.h"
#include "compare/comparison_words.h"
#include "core/atomic_file.h"
#include "core/check.h"
#include "report/html_page.h"

namespace plumb::compare {
namespace {

report::RowKind kind_of(CompareVerdict verdict) {
  return verdict == CompareVerdict::Fails  ? report::RowKind::Bad
         : verdict == CompareVerdict::None ? report::RowKind::Plain
                                           : report::RowKind::Ok;
}

report::Table missing_table(const FolderComparison& folders) {
  report::Table table{"Files that one folder alone has", {{"file"}, {"verdict"}}, {}};
  for (const MissingFile& file : folders.missing)
    table.rows.push_back({{file.name, missing_text(file)}, report::RowKind::Bad});
  return table;
}

report::Table error_table(const FolderComparison& folders) {
  report::Table table{"Files that could not be compared", {{"file"}, {"why", false, true}}, {}};
  for (const FolderError& error : folders.errors)
    table.rows.push_back({{error.name, error.message}, report::RowKind::Bad});
  return table;
}

report::LinkRow pair_row(const FolderPair& pair) {
  const Comparison& c = pair.comparison;
  report::LinkRow row{pair.name, pair.page, pair.thumbnail_png, {}, kind_of(c.verdict)};
  row.cells = {verdict_label(c.verdict), "-", "-", c.reasons.empty() ? "" : c.reasons.front()};
  if (const Judgement* worst = tightest(c)) {
    row.cells[1] = fmt::format("{} {}, {}", worst->measured.name(), value_text(worst->measured),
                               bound_text(worst->limit, worst->measured.info()));
    row.cells[2] = use_text(*worst);
  }
  return row;
}

report::LinkTable pairs_table(const FolderComparison& folders) {
  report::LinkTable table{"Pictures, the worst first: candidate, and where it differs most",
                          "file",
                          {{"verdict"}, {"tightest limit"}, {"used", true}, {"why", false, true}},
                          {}};
  for (const std::size_t at : by_badness(folders))
    table.rows.push_back(pair_row(folders.pairs[at]));
  return table;
}

std::string page_of(const FolderComparison& folders, const std::string& command,
                    const std::string& json) {
  report::HtmlPage page(
      fmt::format("{} compared with {}", folders.candidate_name, folders.reference_name));
  page.add_verdict(banner_of(folders.verdict()), verdict_sentence(folders));
  if (!folders.missing.empty()) page.add_table(missing_table(folders));
  if (!folders.errors.empty()) page.add_table(error_table(folders));
  if (!folders.pairs.empty()) page.add_links(pairs_table(folders));
  page.add_key_values("What was compared", {{"reference", folders.reference_name},
                                            {"candidate", folders.candidate_name},
                                            {"profile", folders.profile},
                                            {"made again by", command}});
  page.add_details("JSON of this comparison", json);
  return page.text();
}

}  // namespace

std::vector<std::string> write_folder_report(const std::filesystem::path& folder,
                                             const FolderComparison& folders,
                                             const std::string& command) {
  make_folder(folder);
  const std::string json = folder_json(folders, command);
  write_file_atomically(folder / "comparison.json", json);
  write_file_atomically(folder / "index.html", page_of(folders, command, json));
  return {"index.html", "comparison.json"};
}

}  // namespace plumb::compare
