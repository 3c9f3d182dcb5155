#include "command.h"

int main(int argc, char** argv) {
  return plumb::tool::run_command_line(plumb::tool::all_commands(), {{argv, argv + argc}});
}
