// Ctrl-C, SIGTERM, SIGHUP and a time limit. A process has one set of signal handlers, so this is a
// set of functions rather than an object.
#pragma once

namespace graycube {

/// From now on the three signals end the process at once, with a line that says so; it dies of the
/// signal, so that shells see that and stop a loop. So does the end of `timeout_s` (0: none), with
/// status 1. `what` names the command in that line; it must live
/// forever. SIGPIPE is ignored, as writing fails with its own error.
void catch_interrupts(const char* what, double timeout_s);

/// While an object of this class lives, an interrupt is only noted, as there is something to put
/// away first. For the main thread only.
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

/// The signal that was noted first, 0 if none was; it can be forgotten, and another noted.
int noted_interrupt();
void forget_interrupt();
void note_interrupt(int signal);

/// Dies of the signal that was noted, once everything is put away. Returns if none was, or the time
/// limit's.
void die_of_interrupt();

/// From now on Ctrl-Z (SIGTSTP) stops a process group together with this process, and what
/// continues this one continues it, too. 0: no group any longer.
void stop_together_with(int process_group);

/// Whether a progress line stands on the terminal, which the message of an interrupt must first
/// remove.
void note_terminal_line(bool is_open);

/// A descriptor that becomes readable when a signal has come, that of a child's end included.
/// clear_wakeup() makes it unreadable.
int wakeup_descriptor();
void clear_wakeup();

}  // namespace graycube
