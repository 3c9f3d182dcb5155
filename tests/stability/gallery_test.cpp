// Every scene of the failure gallery, by what it states.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "audit/method.h"
#include "audit/stability/failure_scene.h"
#include "audit/stability/gallery_text.h"
#include "audit/stability/run_scene.h"

namespace plumb::audit::stability {

struct SceneOfMethod {
  const Scene* scene;
  std::string method;
};

static void PrintTo(const SceneOfMethod& of, std::ostream* out) {
  *out << of.scene->name << ", " << of.method;
}

namespace {

std::vector<SceneOfMethod> all_scenes() {
  std::vector<SceneOfMethod> all;
  for (const Scene& scene : failure_scenes())
    for (const std::string& method : scene.methods) all.push_back({&scene, method});
  return all;
}

// Names of tests have no hyphens.
std::string test_name(const ::testing::TestParamInfo<SceneOfMethod>& info) {
  std::string name = info.param.scene->name + "_of_" + info.param.method;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

class Gallery : public ::testing::TestWithParam<SceneOfMethod> {};

TEST_P(Gallery, IsAsStated) {
  const SceneRun run = run_scene(*GetParam().scene, GetParam().method);
  const auto check = [&](const std::optional<VariantRun>& variant,
                         const std::optional<Expected>& expected) {
    if (!variant) return;
    EXPECT_TRUE(variant->is_as_expected)
        << "expected " << expected_text(*run.scene, *expected) << "; "
        << measured_text(run, variant, expected) << ": " << variant->sentence << variant->refused;
    EXPECT_FALSE(variant->has_nan);
  };
  check(run.published, run.expected_published);
  check(run.conservative, run.expected_conservative);
  EXPECT_TRUE(run.published || run.conservative);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Gallery, ::testing::ValuesIn(all_scenes()), test_name);

TEST(GalleryTable, HasUniqueNamesAndKnownMethods) {
  std::set<std::string> names;
  for (const Scene& scene : failure_scenes()) {
    EXPECT_TRUE(names.insert(scene.name).second) << scene.name;
    EXPECT_FALSE(scene.fails.empty()) << scene.name;
    for (const std::string& method : scene.methods)
      EXPECT_NO_THROW(find_method(built_in_methods(), method)) << scene.name;
  }
}

// A scene that says nothing of a variant would pass whatever is drawn.
TEST(GalleryTable, StatesSomethingOfEveryVariantThatThereIs) {
  for (const Scene& scene : failure_scenes()) {
    for (const std::string& name : scene.methods) {
      const Method& method = find_method(built_in_methods(), name);
      for (const std::string& variant : method.variants) {
        const auto& stated = variant == "published" ? scene.published : scene.conservative;
        EXPECT_TRUE(stated || scene.otherwise.contains(name)) << scene.name << ", " << name;
      }
    }
  }
}

}  // namespace
}  // namespace plumb::audit::stability
