// The manual page lekalo(1) in troff: commands and options as they were declared, between what stands here.
#include <fmt/format.h>

#include "command_table.h"

namespace lekalo::command {

namespace {

constexpr const char* kHead = R"(.\" Written by: lekalo completions man
.TH LEKALO 1 "" "lekalo 0.1" "User Commands"
.SH NAME
lekalo \- render and measure geometric models
.SH SYNOPSIS
.B lekalo
.I COMMAND
.RI [ OPTIONS ]
.I FILE...
.br
.B lekalo
.RB [ COMMAND ]
.B \-\-help
|
.B \-\-version
.SH DESCRIPTION
A scene file says how curves, surfaces and bodies are constructed, how they look and from where.
.B lekalo
ray-traces the exact surfaces (or their tessellation) into OpenEXR and PNG images, draws them as lines in SVG, PDF and TikZ
files, and answers questions about the model in numbers. Every command has a
.B \-\-help
that begins with an example.
.SH COMMANDS
)";

constexpr const char* kTail = R"(.SH EXIT STATUS
.TP
.B 0
done
.TP
.B 1
images differ, or a test failed
.TP
.B 2
wrong usage
.TP
.B 3
error in the scene
.TP
.B 4
a file cannot be read or written
.TP
.B 5
interrupted; the partial result was written
.SH FILES
.TP
.I OUTPUT.partial
Sums of a rendering under way, for
.BR \-\-resume .
.TP
.I OUTPUT.3of8.partial
A part of a picture, for
.BR "lekalo merge" .
.TP
.I PREFIX/share/lekalo/scenes
Scenes that come with the program, found relative to it; also searched in
.I lekalo/scenes
of
.B $XDG_DATA_HOME
and of the folders of
.BR $XDG_DATA_DIRS ,
where models of your own may be kept.
.SH ENVIRONMENT
.TP
.B SOURCE_DATE_EPOCH
The date that outputs carry, instead of the clock, where one is asked for.
.TP
.B XDG_DATA_HOME
Folder of your own data (default: ~/.local/share).
.TP
.B XDG_DATA_DIRS
Folders of shared data (default: /usr/local/share:/usr/share).
)";

// Hyphens that are typed, backslashes, and lines that begin like requests.
std::string troff(const std::string& text) {
  std::string result;
  bool at_begin = true;
  for (const char c : text) {
    if (at_begin && (c == '.' || c == '\'')) result += "\\&";
    at_begin = c == '\n';
    if (c == '\\')
      result += "\\e";
    else if (c == '-')
      result += "\\-";
    else
      result += c;
  }
  return result;
}

// ".B \-o, \-\-output" and, beside it, what it takes.
std::string head_of(const OptionEntry& option) {
  std::string names;
  for (const std::string& name : option.names) names += (names.empty() ? "" : ", ") + troff(name);
  const bool takes = !option.flag && !option.positional && !option.type.empty();
  return takes ? fmt::format(".BI \"{} \" \"{}\"", names, troff(option.type)) : fmt::format(".B \"{}\"", names);
}

std::string option_text(const OptionEntry& option) {
  std::string text = ".TP\n" + head_of(option) + "\n" + troff(option.description);
  std::string values;
  for (const std::string& value : option.values) values += (values.empty() ? "" : ", ") + value;
  // A short list that the description does not name.
  if (!values.empty() && option.description.find(option.values.back()) == std::string::npos)
    text += " (" + troff(values) + ")";
  return text + "\n";
}

}  // namespace

std::string manual_page(const std::vector<CommandEntry>& commands) {
  std::string text = kHead;
  for (const CommandEntry& command : commands) {
    text += fmt::format(".SS {}\n{}\n", command.name, troff(command.description));
    for (const OptionEntry& option : command.options)
      if (option.names.back() != "--help") text += option_text(option);
    if (!command.footer.empty()) text += ".PP\n.nf\n" + troff(command.footer) + "\n.fi\n";
  }
  return text + kTail;
}

}  // namespace lekalo::command
