// The only registry of methods: a row for each.
#include "audit/method_rows.h"

namespace plumb::audit {

const MethodTable& built_in_methods() {
  static const MethodTable table{
      full_row(),
      restricted_quadtree_row(),
      tessellation_row("tessellation",
                       "patches of a compressed quadtree, their blocks refined by a tessellator",
                       true),
      tessellation_row("chunked",
                       "the same patches without fine selection: chunked level of detail", false),
      stacks_row(),
      slicing_row("slicing", "stacks of slices through the terrain; polygons where none can be",
                  false),
      slicing_row("hybrid-slicing", "slices or polygons for each box, whichever costs less", true)};
  return table;
}

}  // namespace plumb::audit
