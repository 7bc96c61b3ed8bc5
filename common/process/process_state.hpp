// What the system says a process of this machine is doing.
#pragma once

namespace graycube {

/// The letter of /proc/PID/stat: 'R' runs or could, 'S' and 'D' wait for something, 'T' was stopped
/// by a signal, 'Z' has ended. 0 if there is no such process.
char process_state(long pid);

/// Whether nothing keeps the process from running but others that run, or what it waits for.
bool can_run(long pid);

}  // namespace graycube
