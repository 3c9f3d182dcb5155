#include "command.h"

namespace plumb::tool {

std::vector<Command> all_commands() {
  return {info_command(),    truth_command(),  render_command(), audit_command(),
          compare_command(), golden_command(), profile_command()};
}

}  // namespace plumb::tool
