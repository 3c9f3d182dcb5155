#include "command.h"

namespace plumb::tool {

std::vector<Command> all_commands() {
  return {info_command(),   truth_command(),     render_command(),   audit_command(),
          build_command(),  decode_command(),    profile_command(),  compare_command(),
          golden_command(), sweep_command(),     merge_command(),    chart_command(),
          plan_command(),   stability_command(), soundness_command()};
}

}  // namespace plumb::tool
