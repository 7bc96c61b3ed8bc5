#include "cli/options/completion.hpp"

#include <utility>

namespace graycube {
namespace {

std::string joined(const std::vector<std::string>& words, const char* between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

/// All names of all options that start with a dash, `--help` among them.
std::vector<std::string> option_names(const CommandDescription& command) {
  std::vector<std::string> names;
  for (const OptionDescription& option : command.options) {
    if (option.is_positional()) continue;
    for (std::string& name : names_of(option)) names.push_back(std::move(name));
  }
  names.insert(names.end(), {"-h", "--help"});
  return names;
}

/// The first positional argument, which stands for all: no command takes two of different kinds.
const OptionDescription* argument_of(const CommandDescription& command) {
  for (const OptionDescription& option : command.options) {
    if (option.is_positional()) return &option;
  }
  return nullptr;
}

/// The text in single quotes, which all three shells understand.
std::string quoted_text(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

// --- bash

/// The statement that offers an option's possible values; empty if these aren't known.
std::string bash_offer(const OptionDescription& option) {
  switch (option.kind) {
    case ValueKind::kFile: return "_graycube_paths -f";
    case ValueKind::kFolder: return "_graycube_paths -d";
    case ValueKind::kChoice: return "_graycube_words " + quoted_text(joined(option.choices, " "));
    case ValueKind::kText: break;
  }
  return "return 0";
}

std::string bash_command(const CommandDescription& command) {
  std::string text = "    " + command.name + ")\n      case $before in\n";
  for (const OptionDescription& option : command.options) {
    if (option.is_positional() || option.is_flag()) continue;
    text += "        " + joined(names_of(option), " | ") + ") " + bash_offer(option) + " ;;\n";
  }
  const OptionDescription* argument = argument_of(command);
  text += "        *)\n          if [[ $word == -* ]]; then\n            _graycube_words " +
          quoted_text(joined(option_names(command), " ")) + "\n          else\n            " +
          (argument != nullptr ? bash_offer(*argument) : "return 0") +
          "\n          fi\n          ;;\n      esac\n      ;;\n";
  return text;
}

std::string bash_text(const CommandLineDescription& commands) {
  std::vector<std::string> names;
  std::string cases;
  for (const CommandDescription& command : commands) {
    names.push_back(command.name);
    cases += bash_command(command);
  }
  return R"(# bash completion of graycube, as 'graycube completion bash' prints it.

_graycube_words() { mapfile -t COMPREPLY < <(compgen -W "$1" -- "$word"); }

_graycube_paths() {
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(compgen "$1" -- "$word")
}

_graycube() {
  local word=$2 before=$3
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
    _graycube_words ')" +
         joined(names, " ") + R"( -h --help --version'
    return
  fi
  case ${COMP_WORDS[1]} in
)" + cases +
         R"(  esac
}

complete -F _graycube graycube
)";
}

// --- zsh

/// Escapes the characters that divide the parts of an `_arguments` specification.
std::string zsh_escaped(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

/// ":MESSAGE:ACTION" for an option's value.
std::string zsh_value(const OptionDescription& option) {
  const std::string name = option.is_positional() ? option.names : option.value;
  const std::string message = ":" + zsh_escaped(name) + ":";
  switch (option.kind) {
    case ValueKind::kFile: return message + "_files";
    case ValueKind::kFolder: return message + "_files -/";
    case ValueKind::kChoice: return message + "(" + joined(option.choices, " ") + ")";
    case ValueKind::kText: break;
  }
  return message;
}

std::string zsh_command(const CommandDescription& command) {
  std::string text = "    " + command.name + ")\n      _arguments \\\n";
  for (const OptionDescription& option : command.options) {
    if (option.is_positional()) {
      text += "        " + quoted_text(zsh_value(option)) + " \\\n";
      continue;
    }
    const std::string value = option.is_flag() ? "" : zsh_value(option);
    // After one name of an option was given, none of its names is offered again.
    const std::string once = option.is_repeatable ? "*" : "(" + joined(names_of(option), " ") + ")";
    for (const std::string& name : names_of(option)) {
      text += "        " + quoted_text(once + name + "[" + zsh_escaped(option.help) + "]" + value) +
              " \\\n";
    }
  }
  return text + "        '(-h --help)'{-h,--help}'[Print the help]'\n      ;;\n";
}

std::string zsh_text(const CommandLineDescription& commands) {
  std::string list, cases;
  for (const CommandDescription& command : commands) {
    list += "    " + quoted_text(command.name + ":" + zsh_escaped(command.help)) + "\n";
    cases += zsh_command(command);
  }
  return R"(#compdef graycube
# zsh completion of graycube, as 'graycube completion zsh' prints it.

_graycube() {
  local -a commands=(
)" + list +
         R"(  )
  if ((CURRENT == 2)); then
    _describe -t commands 'command' commands
    _arguments '(-h --help)'{-h,--help}'[Print the help]' '--version[Print the version]'
    return
  fi
  local command=$words[2]
  shift words
  ((CURRENT--))
  case $command in
)" + cases +
         R"(  esac
}

if [[ $zsh_eval_context[-1] == loadautofunc ]]; then
  _graycube "$@"
else
  compdef _graycube graycube
fi
)";
}

// --- fish

/// The flags that tell what a value may be, such as " -r -F".
std::string fish_value(const OptionDescription& option) {
  switch (option.kind) {
    case ValueKind::kFile: return " -r -F";
    case ValueKind::kFolder: return " -x -a '(__fish_complete_directories)'";
    case ValueKind::kChoice: return " -x -a " + quoted_text(joined(option.choices, " "));
    case ValueKind::kText: break;
  }
  return " -x";
}

std::string fish_option(const std::string& condition, const OptionDescription& option) {
  std::string text = condition;
  if (option.is_positional()) {
    if (option.kind == ValueKind::kText) return "";
    return text + (option.kind == ValueKind::kFile ? " -F" : fish_value(option)) + "\n";
  }
  for (const std::string& name : names_of(option)) {
    text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  }
  if (!option.is_flag()) text += fish_value(option);
  return text + " -d " + quoted_text(option.help) + "\n";
}

std::string fish_text(const CommandLineDescription& commands) {
  std::string text =
      "# fish completion of graycube, as 'graycube completion fish' prints it.\n"
      "complete -c graycube -f\n"
      "complete -c graycube -s h -l help -d 'Print the help'\n"
      "complete -c graycube -n __fish_use_subcommand -l version -d 'Print the version'\n";
  for (const CommandDescription& command : commands) {
    text += "complete -c graycube -n __fish_use_subcommand -a " + command.name + " -d " +
            quoted_text(command.help) + "\n";
  }
  for (const CommandDescription& command : commands) {
    const std::string condition =
        "complete -c graycube -n '__fish_seen_subcommand_from " + command.name + "'";
    for (const OptionDescription& option : command.options) {
      text += fish_option(condition, option);
    }
  }
  return text;
}

}  // namespace

std::string_view to_string(Shell shell) {
  switch (shell) {
    case Shell::kBash: return "bash";
    case Shell::kZsh: return "zsh";
    case Shell::kFish: break;
  }
  return "fish";
}

std::string completion_text(Shell shell, const CommandLineDescription& commands) {
  switch (shell) {
    case Shell::kBash: return bash_text(commands);
    case Shell::kZsh: return zsh_text(commands);
    case Shell::kFish: break;
  }
  return fish_text(commands);
}

}  // namespace graycube
