// Ctrl-C, SIGTERM, SIGHUP and a time limit. A process has one set of signal handlers, so this is a
// set of functions rather than an object.
#pragma once

namespace graycube {

/// From now on the three signals, and the end of `timeout_s` (0: none), end the process at once
/// with status 1 and a line that says so. `what` names the command in it; it must live forever.
/// SIGPIPE is ignored: writing says so itself.
void catch_interrupts(const char* what, double timeout_s);

/// While one lives, an interrupt is only noted: there is something to put away first. Main thread
/// only.
class InterruptsHeld {
 public:
  InterruptsHeld();
  ~InterruptsHeld();
  InterruptsHeld(const InterruptsHeld&) = delete;
  InterruptsHeld& operator=(const InterruptsHeld&) = delete;
};

bool is_interrupted();

/// Throws the Failure of an interrupt that was noted.
void throw_if_interrupted();

/// Whether a progress line stands on the terminal, which the message of an interrupt must first
/// remove.
void note_terminal_line(bool is_open);

/// Becomes readable when a signal has come, of a child that ended too. `clear_wakeup` makes it
/// unreadable.
int wakeup_descriptor();
void clear_wakeup();

}  // namespace graycube
