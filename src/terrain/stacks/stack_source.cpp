#include "terrain/stacks/stack_source.h"

#include <algorithm>

#include "core/check.h"
#include "terrain/memory_check.h"
#include "terrain/stacks/caves.h"
#include "terrain/stacks/stack_rows.h"

namespace plumb::terrain {

bool is_stack_generator(const std::string& argument) {
  if (!is_generator(argument)) return false;
  for (const GeneratorHelp& help : generator_help()) {
    const std::string name = "generate:" + help.name;
    if (!help.makes_stacks || (argument != name && !argument.starts_with(name + "?"))) continue;
    return ("&" + argument.substr(std::min(name.size() + 1, argument.size())) + "&")
               .find("&surface=top&") == std::string::npos;
  }
  return false;
}

StackField make_stacks(const GeneratorValues& values) {
  const GridShape grid = values.shape();
  const Caves caves(values, grid);
  const double part = values.number("voids", 0.0, 1.0);
  const glm::dvec2 origin_m = values.origin_m();
  require_memory("generate:" + values.name(), grid.columns, grid.rows, kBytesAStack);
  const GeneratedVoids voids(grid.columns, grid.rows, part, values.void_seed());
  StackField field =
      field_of_rows(caves.shape(), [&](int j, StackWriter& row) { caves.fill_row(j, voids, row); });
  field.origin_m = origin_m;
  field.provenance.source = values.canonical();
  field.provenance.format = "generated";
  field.provenance.file_columns = grid.columns;
  field.provenance.file_rows = grid.rows;
  field.provenance.voids_declared = voids.count();
  return field;
}

StackField generate_stacks(const std::string& argument) {
  const GeneratorValues values(argument);
  if (!values.makes_stacks())
    input_error("generate:{}: a terrain of heights, expected one of stacks: caves", values.name());
  if (values.text("surface") != "stacks")
    values.refuse("surface", values.text("surface") == "top" ? "stacks, as stacks are asked for"
                                                             : "stacks or top");
  return make_stacks(values);
}

}  // namespace plumb::terrain
