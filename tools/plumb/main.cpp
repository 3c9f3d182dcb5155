#include "command.h"
#include "core/atomic_file.h"

int main(int argc, char** argv) {
  plumb::remove_temporary_files_on_interrupt();
  return plumb::tool::run_command_line(plumb::tool::all_commands(), {{argv, argv + argc}});
}
