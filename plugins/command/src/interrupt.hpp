#pragma once
/// Ctrl-C and SIGTERM: the first asks the computation to stop, the second kills the program.

namespace hauberk::command {

/// Catches SIGINT and SIGTERM from now on.
void catch_interrupts();

/// True after the first of them. Thread safe.
bool interrupted();

}  // namespace hauberk::command
