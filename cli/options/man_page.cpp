#include "cli/options/man_page.hpp"

#include "version.hpp"

namespace graycube {
namespace {

/// Text for roff: dashes are those of options, and no line starts a request.
std::string roff(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (escaped.empty() && (c == '.' || c == '\'')) escaped += "\\&";
    if (c == '\\') {
      escaped += "\\e";
    } else {
      if (c == '-') escaped += '\\';
      escaped += c;
    }
  }
  return escaped;
}

std::string bold(const std::string& text) { return "\\fB" + roff(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + roff(text) + "\\fR"; }

/// An entry of a list: ".TP", the thing that is explained, and its explanation.
std::string entry(const std::string& head, const std::string& text) {
  return ".TP\n" + head + "\n" + roff(text) + "\n";
}

std::string head_of(const OptionDescription& option) {
  if (option.is_positional()) return italic(option.names);
  std::string head;
  for (const std::string& name : names_of(option)) head += (head.empty() ? "" : ", ") + bold(name);
  return option.is_flag() ? head : head + " " + italic(option.value);
}

std::string command_section(const CommandDescription& command) {
  std::string text = ".SS " + command.name + "\n";
  std::string usage = ".B graycube " + command.name + "\n";
  for (const OptionDescription& option : command.options) {
    if (option.is_positional()) usage += italic(option.names) + "\n";
  }
  for (const OptionDescription& option : command.options) {
    if (option.is_required && !option.is_positional()) usage += head_of(option) + "\n";
  }
  text += usage + "[options]\n.PP\n" + roff(command.help) + ".\n";
  for (const OptionDescription& option : command.options) {
    text += entry(head_of(option), option.help);
  }
  return text;
}

std::string head() {
  return std::string(".TH GRAYCUBE 1 \"\" \"graycube ") + kVersion + R"(" "User commands"
.SH NAME
graycube, graycube\-frontal, graycube\-node \- render solid models by ray tracing, on many processes
.SH SYNOPSIS
.B graycube
.I COMMAND
[options]
.br
.B graycube
.I COMMAND
.B \-\-help
.br
.B graycube \-\-version
.SH DESCRIPTION
.B graycube
renders solid models (unions, differences and intersections of solids) by ray tracing.
Nodes, which are processes wired as a hypercube, each hold a part of the scene and hand rays on to
their neighbours. The picture has the same bytes however many nodes there are.
.PP
.B graycube
starts
.B graycube\-frontal
and that starts
.BR graycube\-node ;
nobody needs to call these two, which lie in the same folder.
.SH COMMANDS
)";
}

std::string tail() {
  std::string text = ".SH EXIT STATUS\n";
  text += entry(bold("0"), "Done.");
  text += entry(
      bold("1"),
      "It failed: the render, its time limit, a node that died, a farm that doesn't answer, a "
      "file that could not be written. An interrupt ends the command by its signal.");
  text += entry(bold("2"),
                "Bad usage or bad input: the command line, the scene, a job that doesn't exist.");
  text +=
      ".PP\nErrors go to standard error, one line each, as\n.BR \"graycube: WHAT: WHERE: WHY\" .\n";
  text += ".SH ENVIRONMENT\n";
  text += entry(bold("GRAYCUBE_FRONTAL"), "Where the farm is, for commands without --connect.");
  text += entry(bold("GRAYCUBE_SIMD"),
                "The widest vector instructions to use; the same picture, more slowly.");
  text += entry(bold("XDG_RUNTIME_DIR"),
                "A farm listens at graycube/frontal in this folder unless told otherwise.");
  text += R"(.SH EXAMPLES
A picture of a part, smoothed, and what the render did:
.PP
.nf
graycube render part.scad \-\-samples 3 \-\-png part.png \-\-stats part.json
.fi
.PP
A farm that renders one job after another:
.PP
.nf
graycube up \-n 8 \-\-http 127.0.0.1:8080 &
graycube submit part.json \-\-wait \-o part.exr
graycube down
.fi
.PP
The same farm as a service of the user's:
.PP
.nf
systemctl \-\-user start graycube
.fi
.SH SEE ALSO
.BR openscad (1),
.BR systemctl (1)
)";
  return text;
}

}  // namespace

std::string man_page(const CommandLineDescription& commands) {
  std::string text = head();
  for (const CommandDescription& command : commands) text += command_section(command);
  text +=
      ".PP\nEvery command also takes\n.BR \\-h \" and \" \\-\\-help ,\nwhich print its options.\n";
  return text + tail();
}

}  // namespace graycube
