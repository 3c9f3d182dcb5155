#include "audit/sweep/result_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "audit/sweep/merge.h"
#include "audit/toml_document.h"
#include "support/run_command.h"
#include "unit/audit/small_sweeps.h"

namespace plumb::audit::sweep {
namespace {

using plumb::testing::TemporaryFolder;

const MethodTable& table() {
  static const MethodTable methods = small_methods();
  return methods;
}

const SweepPlan& plan() {
  static const SweepPlan made = small_plan(kSmallSweep, table());
  return made;
}

// All lines of the small sweep, in order, ending in line feeds.
const std::string& whole() {
  static const std::string text = [] {
    std::string lines;
    for (const std::string& line : lines_of(plan(), all_runs(plan()), table()))
      lines += line + "\n";
    return joined_text(merged({{"all", parse_results(lines, "all").lines}}));
  }();
  return text;
}

std::string error_of(const std::string& text) {
  try {
    parse_results(text, "r.jsonl");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  return text.replace(text.find(what), what.size(), by);
}

TEST(SweepResults, LeavesATornLastLineOut) {
  const std::string& text = whole();
  ASSERT_EQ(parse_results(text, "r").lines.size(), 12u);
  const ResultLines torn = parse_results(std::string_view(text).substr(0, text.size() - 1), "r");
  EXPECT_EQ(torn.lines.size(), 11u);
  EXPECT_EQ(text[torn.whole_bytes - 1], '\n');
  EXPECT_EQ(parse_results("{", "r").lines.size(), 0u);
  EXPECT_EQ(parse_results("{", "r").whole_bytes, 0u);
}

TEST(SweepResults, RefusesLinesThatAreNone) {
  EXPECT_EQ(error_of("{}\n"), "r.jsonl, line 1: this is no result of a sweep");
  EXPECT_EQ(error_of(whole() + "\n"), "r.jsonl, line 13: this is no result of a sweep");
  EXPECT_EQ(error_of(replaced(whole(), "plumb.sweep/1", "plumb.sweep/2")),
            "r.jsonl, line 1: its schema is \"plumb.sweep/2\", expected \"plumb.sweep/1\"");
  const std::string key = plan().runs[0].key;
  EXPECT_EQ(
      error_of(replaced(whole(), "\"value\":1.0", "\"value\":1.5")),
      "r.jsonl, line 1: its key " + key + " is not that of what it asked: somebody has changed it");
}

TEST(SweepResults, SaysWhatALineHolds) {
  const std::vector<ResultLine> lines = parse_results(whole(), "r").lines;
  EXPECT_EQ(lines[3].index, 3);
  EXPECT_EQ(lines[3].key, plan().runs[3].key);
  EXPECT_EQ(lines[3].status, "done");
  EXPECT_EQ(lines[3].verdict, "held");
  EXPECT_EQ(lines[3].run, "plane, exact, conservative, 2px, top");
  EXPECT_EQ(lines[3].run, name_of(plan(), plan().runs[3]));
  EXPECT_TRUE(lines[3].shared_times);
}

TEST(ResultFile, TakesATornLineAwayAndAppends) {
  const TemporaryFolder folder;
  const std::string path = folder.file("r.jsonl");
  const std::vector<ResultLine> lines = parse_results(whole(), "r").lines;
  std::ofstream(path) << lines[0].text << "\n" << lines[1].text.substr(0, 40);
  {
    ResultFile file(path);
    ASSERT_EQ(file.lines().size(), 1u);
    file.append(lines[2].text);
    EXPECT_EQ(file.lines().size(), 2u);
  }
  EXPECT_EQ(read_text_file(path, "results"), lines[0].text + "\n" + lines[2].text + "\n");
}

TEST(ResultFile, IsOneProcessesAlone) {
  const TemporaryFolder folder;
  const std::string path = folder.file("r.jsonl");
  ResultFile file(path);
  EXPECT_THROW(ResultFile{path}, InputError);
  file.replace({parse_results(whole(), "r").lines[0]});
  EXPECT_THROW(ResultFile{path}, InputError);  // the new file, too
}

TEST(ResultFile, LeavesAFileThatIsNoneOfItsKindAlone) {
  const TemporaryFolder folder;
  const std::string path = folder.file("diary.txt");
  std::ofstream(path) << "Dear diary,\nnothing of note";
  EXPECT_THROW(ResultFile{path}, InputError);
  EXPECT_EQ(read_text_file(path, "diary"), "Dear diary,\nnothing of note");
}

TEST(SweepMerge, PutsPartsIntoTheSceneOrder) {
  const std::vector<ResultLine> lines = parse_results(whole(), "r").lines;
  std::vector<NamedResults> parts{{"a", {lines[5], lines[1]}}, {"b", {lines[3], lines[1]}}};
  const std::vector<ResultLine> all = merged(parts);
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0].key, lines[1].key);
  EXPECT_EQ(all[1].key, lines[3].key);
  EXPECT_EQ(all[2].key, lines[5].key);
}

TEST(SweepMerge, TakesTimesThatMeanSomething) {
  const ResultLine shared = parse_results(whole(), "r").lines[0];
  const ResultLine alone =
      parse_results(replaced(shared.text, "\"shared\":true", "\"shared\":false") + "\n", "r")
          .lines[0];
  EXPECT_FALSE(merged({{"a", {shared}}, {"b", {alone}}})[0].shared_times);
  EXPECT_FALSE(merged({{"a", {alone}}, {"b", {shared}}})[0].shared_times);
}

TEST(SweepMerge, RefusesOtherResultsOfOneRun) {
  const ResultLine line = parse_results(whole(), "r").lines[0];
  const ResultLine other =
      parse_results(replaced(line.text, "\"verdict\":\"held\"", "\"verdict\":\"broken\"") + "\n",
                    "r")
          .lines[0];
  try {
    merged({{"a.jsonl", {line}}, {"b.jsonl", {other}}});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()), "a.jsonl and b.jsonl: run " + line.key +
                                             " (plane, exact, conservative, 1px, oblique) has "
                                             "another result there");
  }
}

TEST(SweepMerge, RefusesPartsOfDifferentScenes) {
  const std::vector<ResultLine> lines = parse_results(whole(), "r").lines;
  EXPECT_THROW(merged({{"a", {lines[0]}}, {"b", {with_index(lines[1], 0)}}}), InputError);
}

// A scene with another first tolerance: four lines are none of it, the rest moves.
TEST(SweepResume, KeepsWhatTheSceneAsksInItsOrder) {
  std::string text = kSmallSweep;
  text.replace(text.find("[1, 2, 4]"), 9, "[4, 2, 8]");
  const SweepPlan changed = small_plan(text, table());
  const Resumed resumed = sweep::resumed(changed, parse_results(whole(), "r").lines, {});
  EXPECT_EQ(resumed.others.size(), 4u);
  ASSERT_EQ(resumed.kept.size(), 8u);
  EXPECT_EQ(resumed.kept[0].run, "plane, exact, conservative, 4px, oblique");
  EXPECT_EQ(resumed.kept[0].index, 0);
  EXPECT_NE(resumed.kept[0].text.find("\"index\":0,"), std::string::npos);
  EXPECT_EQ(resumed.kept[4].index, 6);
  EXPECT_EQ(parse_results(joined_text(resumed.kept), "r").lines.size(), 8u);
}

TEST(SweepResume, TakesOutWhatIsToBeRunAgain) {
  const std::vector<ResultLine> lines = parse_results(whole(), "r").lines;
  EXPECT_EQ(resumed(plan(), lines, {}).stale.size(), 0u);
  EXPECT_EQ(resumed(plan(), lines, {.failed = true}).stale.size(), 0u);
  EXPECT_EQ(resumed(plan(), lines, {.shared_times = true}).stale.size(), 12u);
}

}  // namespace
}  // namespace plumb::audit::sweep
