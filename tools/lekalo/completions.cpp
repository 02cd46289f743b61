// lekalo completions: shell completions and the manual page, from the commands' own declarations.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <map>

#include "command_table.h"

namespace lekalo::command {

namespace {

// "TEXT:{obj,ply}": the values in braces.
std::vector<std::string> values_in(const std::string& type) {
  const size_t begin = type.find(":{"), end = type.find('}', begin);
  if (begin == std::string::npos || end == std::string::npos) return {};
  std::vector<std::string> values{""};
  for (const char c : type.substr(begin + 2, end - begin - 2)) {
    if (c == ',')
      values.emplace_back();
    else
      values.back() += c;
  }
  return values;
}

// The type without what CLI11 appends of the option's checks.
std::string type_of(CLI::Option& option) {
  std::string checks;
  try {
    for (int i = 0;; ++i) {
      const std::string one = option.get_validator(i)->get_description();
      if (!one.empty()) checks += (checks.empty() ? "" : ":") + one;
    }
  } catch (const CLI::OptionNotFound&) {
    // That was the last of them.
  }
  std::string type = option.get_type_name();
  if (!checks.empty() && type.ends_with(":" + checks)) type.erase(type.size() - checks.size() - 1);
  return type;
}

OptionEntry entry_of(CLI::Option& option) {
  OptionEntry entry;
  for (const std::string& name : option.get_snames()) entry.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) entry.names.push_back("--" + name);
  entry.positional = entry.names.empty();
  if (entry.positional) entry.names.push_back(option.get_name(true));
  entry.flag = !entry.positional && option.get_items_expected_max() == 0;
  entry.repeatable = option.get_items_expected_max() > 1;
  entry.values = values_in(option.get_type_name());
  entry.type = type_of(option);
  entry.description = option.get_description();
  return entry;
}

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? "'\\''" : std::string(1, c);
  return result + "'";
}

std::string joined(const std::vector<std::string>& words, const char* between = " ") {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

bool takes_scene(const CommandEntry& command) {
  return std::any_of(command.options.begin(), command.options.end(), [](const OptionEntry& option) {
    return option.positional && (option.names.front() == "scene" || option.names.front() == "suite");
  });
}

// "render:--size | make:--size".
using Cases = std::map<std::string, std::vector<std::string>>;
void add_cases(const CommandEntry& command, const OptionEntry& option, Cases& cases) {
  const std::string action = !option.values.empty()  ? "words='" + joined(option.values) + "'"
                             : option.type == "FILE" ? "compopt -o default; return"
                             : option.type == "DIR"  ? "compopt -o dirnames; return"
                                                     : "return";
  for (const std::string& name : option.names) cases[action].push_back(command.name + ":" + name);
}

}  // namespace

std::vector<CommandEntry> command_table(CLI::App& app) {
  std::vector<CommandEntry> commands;
  for (CLI::App* sub : app.get_subcommands([](CLI::App*) { return true; })) {
    CommandEntry command{sub->get_name(), sub->get_description(), sub->get_footer(), {}};
    for (CLI::Option* option : sub->get_options()) command.options.push_back(entry_of(*option));
    commands.push_back(std::move(command));
  }
  return commands;
}

std::string bash_completion(const std::vector<CommandEntry>& commands) {
  Cases cases;
  std::string names, options, positionals;
  for (const CommandEntry& command : commands) {
    names += command.name + " ";
    std::string words;
    for (const OptionEntry& option : command.options) {
      if (option.positional && !option.values.empty())
        positionals += fmt::format("        {}) words='{}' ;;\n", command.name, joined(option.values));
      if (option.positional) continue;
      words += (words.empty() ? "" : " ") + joined(option.names);
      if (!option.flag) add_cases(command, option, cases);
    }
    options += fmt::format("        {}) words='{}' ;;\n", command.name, words);
  }
  std::string arguments, scenes;
  for (const auto& [action, of] : cases) arguments += fmt::format("    {})\n      {} ;;\n", joined(of, " | "), action);
  for (const CommandEntry& command : commands)
    if (takes_scene(command)) scenes += (scenes.empty() ? "" : " | ") + command.name;
  return fmt::format(R"(# bash completion for lekalo(1), written by: lekalo completions bash

_lekalo() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD - 1]}} command=${{COMP_WORDS[1]}} words=''
  COMPREPLY=()

  case $command:$previous in
{}  esac
  if [[ -z $words ]]; then
    if (( COMP_CWORD == 1 )); then
      words='{}--help --version'
    elif [[ $current == -* ]]; then
      case $command in
{}      esac
    elif (( COMP_CWORD == 2 )); then
      case $command in
{}      esac
    fi
  fi
  if [[ -n $words ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
  else
    local file pattern=''
    case $command in
      {}) pattern='\.(yaml|yml|json)$' ;;
    esac
    while read -r file; do
      [[ ! -d $file && ! $file =~ $pattern ]] || COMPREPLY+=("$file")
    done < <(compgen -f -- "$current")
    compopt -o filenames
  fi
}}
complete -F _lekalo lekalo
)",
                     arguments, names, options, positionals, scenes);
}

namespace {

// Within '...[here]...' of _arguments.
std::string zsh_text(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') result += '\\';
    result += c;
  }
  return result;
}

std::string zsh_action(const OptionEntry& option) {
  const std::string message = ":" + zsh_text(option.type.empty() ? "value" : option.type) + ":";
  if (!option.values.empty()) return message + "(" + joined(option.values) + ")";
  const bool file =
      option.positional ? option.type != "NAME" && option.type != "TEXT" : option.type.starts_with("FILE");
  return message + (file ? "_files" : option.type == "DIR" ? "_files -/" : " ");
}

std::string zsh_argument(const OptionEntry& option) {
  if (option.positional) {
    const bool scene = option.names.front() == "scene" || option.names.front() == "suite";
    return quoted((option.repeatable ? "*" : "") +
                  (scene ? std::string(":scene:_files -g \"*.(yaml|yml|json)\"") : zsh_action(option)));
  }
  const std::string rest = "[" + zsh_text(option.description) + "]" + (option.flag ? "" : zsh_action(option));
  std::string text;
  for (const std::string& name : option.names)
    text += (text.empty() ? "" : " ") + quoted((option.repeatable ? "*" : "") + name + rest);
  return text;
}

}  // namespace

std::string zsh_completion(const std::vector<CommandEntry>& commands) {
  std::string names, cases;
  for (const CommandEntry& command : commands) {
    names += "  " + quoted(command.name + ":" + zsh_text(command.description)) + "\n";
    cases += fmt::format("  {})\n    _arguments", command.name);
    for (const OptionEntry& option : command.options) cases += " \\\n      " + zsh_argument(option);
    cases += " ;;\n";
  }
  return fmt::format(R"(#compdef lekalo
# zsh completion for lekalo(1), written by: lekalo completions zsh

local -a commands
commands=(
{})

if (( CURRENT == 2 )); then
  _describe command commands
  _arguments '--help[show help]' '--version[show the version]'
  return
fi

local command=$words[2]
shift words
(( CURRENT-- ))
case $command in
{}esac
)",
                     names, cases);
}

std::string fish_completion(const std::vector<CommandEntry>& commands) {
  std::string names, lines;
  for (const CommandEntry& command : commands) {
    names += " " + command.name;
    lines += fmt::format("complete -c lekalo -n \"not __fish_seen_subcommand_from $commands\" -a {} -d {}\n",
                         command.name, quoted(command.description));
  }
  for (const CommandEntry& command : commands)
    for (const OptionEntry& option : command.options) {
      std::string words;
      for (const std::string& name : option.names)
        if (!option.positional)
          words += name.starts_with("--") ? " -l " + name.substr(2) : fmt::format(" -s {}", name.substr(1));
      const bool files = option.type == "FILE" || option.type == "DIR";
      if (!option.values.empty())
        words += fmt::format(" {}-a {}", option.positional ? "" : "-x ", quoted(joined(option.values)));
      else if (option.positional)
        continue;
      else if (!option.flag)
        words += files ? " -r" : " -x";
      lines += fmt::format("complete -c lekalo -n '__fish_seen_subcommand_from {}'{} -d {}\n", command.name, words,
                           quoted(option.description));
    }
  return fmt::format(
      "# fish completion for lekalo(1), written by: lekalo completions fish\n\n"
      "set -l commands{}\n"
      "complete -c lekalo -n \"not __fish_seen_subcommand_from $commands\" -f\n"
      "complete -c lekalo -n \"not __fish_seen_subcommand_from $commands\" -l help -d 'show help'\n"
      "complete -c lekalo -n \"not __fish_seen_subcommand_from $commands\" -l version -d 'show the version'\n{}",
      names, lines);
}

void add_completions(CLI::App& app, Action& action) {
  auto* sub = app.add_subcommand("completions", "Print completions for a shell, or the manual page");
  sub->footer(
      "Examples:\n"
      "  lekalo completions bash > ~/.local/share/bash-completion/completions/lekalo\n"
      "  lekalo completions man | man -l -");
  auto kind = std::make_shared<std::string>();
  sub->add_option("kind", *kind, "bash, zsh, fish or man")
      ->required()
      ->type_name("KIND")
      ->check(CLI::IsMember({"bash", "zsh", "fish", "man"}));
  sub->callback([&action, &app, kind] {
    action = [&app, kind]() -> int {
      const std::vector<CommandEntry> commands = command_table(app);
      std::fputs((*kind == "bash"   ? bash_completion(commands)
                  : *kind == "zsh"  ? zsh_completion(commands)
                  : *kind == "fish" ? fish_completion(commands)
                                    : manual_page(commands))
                     .c_str(),
                 stdout);
      return kDone;
    };
  });
}

}  // namespace lekalo::command
