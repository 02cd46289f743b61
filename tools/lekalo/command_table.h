// The program's commands and options as they were declared: what shell completions and the manual page are made of.
#pragma once

#include <string>
#include <vector>

#include "command.h"

namespace lekalo::command {

struct OptionEntry {
  std::vector<std::string> names;  // with their dashes; of a positional argument its bare name
  bool positional = false, flag = false, repeatable = false;
  std::string type;                 // FILE, DIR, WxH, ...
  std::vector<std::string> values;  // that it takes; empty: any
  std::string description;
};

struct CommandEntry {
  std::string name, description, footer;
  std::vector<OptionEntry> options;
};

std::vector<CommandEntry> command_table(CLI::App& app);

// The command that prints them.
void add_completions(CLI::App& app, Action& action);

std::string bash_completion(const std::vector<CommandEntry>& commands);
std::string zsh_completion(const std::vector<CommandEntry>& commands);
std::string fish_completion(const std::vector<CommandEntry>& commands);
std::string manual_page(const std::vector<CommandEntry>& commands);

}  // namespace lekalo::command
