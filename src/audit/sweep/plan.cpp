#include "audit/sweep/plan.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>

#include "audit/frame_memory.h"
#include "audit/sweep/line_json.h"
#include "audit/terrain_table.h"
#include "core/check.h"
#include "core/shell_text.h"
#include "terrain/generators.h"
#include "terrain/terrain_source.h"

namespace plumb::audit::sweep {
namespace {

PlacedTerrain place(const SweepTerrain& terrain, const SweepScene& scene) {
  PlacedTerrain placed;
  placed.field = std::make_shared<const terrain::Heightfield>(
      terrain::load_terrain(terrain.path, terrain.read));
  placed.source =
      terrain::is_generator(terrain.source) ? placed.field->provenance.source : terrain.source;
  placed.checksum = fmt::format("{:016x}", terrain::checksum(*placed.field));
  for (std::size_t c = 0; c < scene.cameras.size(); ++c) {
    const SweepCamera& camera = scene.cameras[c];
    for (std::size_t k = 0; k < camera.frames.size(); ++k) {
      try {
        PlacedView view{c, camera.is_path ? static_cast<int>(k) + 1 : 0,
                        place_camera(camera.frames[k], *placed.field).camera};
        require_frame_memory(view.placed, camera.is_path ? kPathAuditBytes : kAuditBytes);
        placed.views.push_back(view);
      } catch (const InputError& error) {
        input_error("{}: camera {} over {}: {}", camera.where, camera.name, terrain.name,
                    error.what());
      }
    }
  }
  return placed;
}

template <class Item, class NameOf>
std::string joined(const std::vector<Item>& items, const NameOf& name_of_item) {
  std::string text;
  for (const Item& item : items)
    text += (text.empty() ? "" : ", ") + std::string(name_of_item(item));
  return text;
}

std::string why_not(const Method& method, const std::string& variant, const SweepTerrain& terrain,
                    const terrain::Heightfield& field) {
  const auto& variants = method.variants;
  if (std::find(variants.begin(), variants.end(), variant) == variants.end())
    return fmt::format("method {} has no variant '{}': it has {}", method.name, variant,
                       joined(variants, [](const std::string& name) { return name; }));
  if (field.stacks != nullptr && !method.takes_stacks)
    return fmt::format("method {} draws heights, and {} is a terrain of stacks", method.name,
                       terrain.name);
  return "";
}

std::string why_not(const Method& method, const Tolerance& tolerance) {
  const auto& units = method.tolerance_units;
  if (std::find(units.begin(), units.end(), tolerance.unit) != units.end()) return "";
  return fmt::format("method {} promises nothing in '{}': its tolerances are in {}", method.name,
                     name_of(tolerance.unit),
                     joined(units, [](Unit unit) { return name_of(unit); }));
}

class Planner {
 public:
  Planner(SweepScene scene, const MethodTable& table, const std::string& version)
      : table_(table), version_(version) {
    plan_.scene = std::move(scene);
  }

  SweepPlan plan() {
    for (const SweepTerrain& terrain : plan_.scene.terrains)
      plan_.terrains.push_back(place(terrain, plan_.scene));
    for (std::size_t t = 0; t < plan_.terrains.size(); ++t) {
      for (const SweepMethod& method : plan_.scene.methods) {
        const auto& names = method.terrains;
        const std::string& name = plan_.scene.terrains[t].name;
        if (std::find(names.begin(), names.end(), name) != names.end()) add_method(t, method);
      }
    }
    return std::move(plan_);
  }

 private:
  void add_method(std::size_t terrain, const SweepMethod& asked) {
    const Method& method = find_method(table_, asked.name);
    const SweepTerrain& described = plan_.scene.terrains[terrain];
    for (const auto& parameters : asked.parameters) {
      for (const std::string& variant : asked.variants) {
        RunGroup group{terrain, &method, {variant, parameters}, method.truth, ""};
        if (!described.diagonal.empty())
          group.diagonal = terrain::parse_diagonal(described.diagonal);
        group.skipped = why_not(method, variant, described, *plan_.terrains[terrain].field);
        if (group.skipped.empty()) group.choice = resolved_choice(method, group.choice);
        plan_.groups.push_back(std::move(group));
        add_runs(asked);
      }
    }
  }

  void add_runs(const SweepMethod& asked) {
    const std::size_t at = plan_.groups.size() - 1;
    const RunGroup& group = plan_.groups[at];
    const auto& tolerances = takes_sizes(group) ? plan_.scene.sizes : asked.tolerances;
    for (const Tolerance& tolerance : tolerances) {
      for (std::size_t v = 0; v < plan_.terrains[group.terrain].views.size(); ++v) {
        PlannedRun run{at, v, tolerance, "", "", group.skipped};
        if (run.skipped.empty()) run.skipped = why_not(*group.method, tolerance);
        run.asked = asked_text(plan_, run, version_);
        run.key = key_of(run.asked);
        const auto [earlier, is_new] = keys_.try_emplace(run.key, plan_.runs.size());
        if (!is_new)
          input_error("the sweep asks twice for {}: it is also {}", name_of(plan_, run),
                      name_of(plan_, plan_.runs[earlier->second]));
        plan_.runs.push_back(std::move(run));
      }
    }
  }

  bool takes_sizes(const RunGroup& group) const {
    const std::vector<std::string>& variants = group.method->size_variants;
    return !plan_.scene.sizes.empty() &&
           std::find(variants.begin(), variants.end(), group.choice.variant) != variants.end();
  }

  const MethodTable& table_;
  const std::string& version_;
  SweepPlan plan_;
  std::map<std::string, std::size_t> keys_;
};

std::string camera_name(const SweepPlan& plan, const PlacedView& view) {
  std::string name = plan.scene.cameras[view.camera].name;
  if (view.frame > 0) name += fmt::format(" frame {}", view.frame);
  return name;
}

}  // namespace

std::string key_of(const std::string& asked) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char c : asked) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 0x100000001b3ULL;
  }
  return fmt::format("{:016x}", hash);
}

SweepPlan plan_sweep(SweepScene scene, const MethodTable& table,
                     const std::string& program_version) {
  return Planner(std::move(scene), table, program_version).plan();
}

std::string command_of(const SweepPlan& plan, const PlannedRun& run) {
  const RunGroup& group = plan.groups[run.group];
  const PlacedTerrain& terrain = plan.terrains[group.terrain];
  const SweepTerrain& described = plan.scene.terrains[group.terrain];
  const PlacedView& view = terrain.views[run.view];
  std::vector<std::string> words{"plumb", "audit", terrain.source};
  for (const auto& [name, value] : argument_texts(described.read)) {
    std::string option = name;
    std::replace(option.begin(), option.end(), '_', '-');
    words.insert(words.end(), {"--" + option, value});
  }
  if (!described.diagonal.empty()) words.insert(words.end(), {"--diagonal", described.diagonal});
  words.insert(words.end(), {"--method", group.method->name, "--variant", group.choice.variant});
  for (const auto& [name, value] : group.choice.parameters)
    words.insert(words.end(), {"--set", name + "=" + value});
  words.insert(words.end(), {"--tolerance", to_text(run.tolerance), "--camera",
                             plan.scene.cameras[view.camera].argument});
  if (view.frame > 0) words.insert(words.end(), {"--frame", fmt::format("{}", view.frame)});
  words.insert(words.end(),
               {"--size", fmt::format("{}x{}", view.placed.width_px, view.placed.height_px)});
  return shell_line(words);
}

std::string name_of(const SweepPlan& plan, const PlannedRun& run) {
  const RunGroup& group = plan.groups[run.group];
  return fmt::format("{}, {}, {}, {}, {}", plan.scene.terrains[group.terrain].name,
                     group.method->name, group.choice.variant, to_text(run.tolerance),
                     camera_name(plan, plan.terrains[group.terrain].views[run.view]));
}

std::vector<std::size_t> shard_of(const SweepPlan& plan, int part, int parts) {
  require(part >= 1 && part <= parts, "a part must be from 1 to {}, got {}", parts, part);
  const auto n = static_cast<std::size_t>(parts);
  std::vector<std::size_t> runs;
  for (std::size_t k = 0; k < plan.runs.size(); ++k) {
    // Shifted by one from each row of n to the next, so that no part gets one tolerance alone.
    if ((k + k / n) % n + 1 == static_cast<std::size_t>(part)) runs.push_back(k);
  }
  return runs;
}

}  // namespace plumb::audit::sweep
