#include "command.h"

namespace plumb::tool {

std::vector<Command> all_commands() { return {info_command(), truth_command(), audit_command()}; }

}  // namespace plumb::tool
