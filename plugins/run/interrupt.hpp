#pragma once
/// Ctrl-C, SIGTERM and a closed terminal: the first asks the computation to stop, the second kills the
/// program.

namespace hauberk {

/// Catches SIGINT and SIGTERM from now on, and SIGHUP unless it is ignored (nohup). A file that grows beyond
/// what is allowed and a reader of the progress that went away are errors of writing, not the end: SIGXFSZ
/// and SIGPIPE are ignored.
void catch_interrupts();

/// True after the first of them. Thread safe.
bool interrupted();

}  // namespace hauberk
