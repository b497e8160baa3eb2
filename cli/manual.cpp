#include "cli/manual.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/cli.h"
#include "maxwrench/load.h"
#include "maxwrench/strategies.h"
#include "maxwrench/version.h"

namespace maxwrench {
namespace {

using CommandOptions = std::vector<const CLI::Option*>;

std::vector<const CLI::App*> shown_subcommands(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
}

bool is_flag(const CLI::Option& option) { return option.get_items_expected_max() == 0; }

/// The named options of a command, or its positional arguments.
CommandOptions options_of(const CLI::App& command, bool positional) {
  return command.get_options([positional](const CLI::Option* option) {
    return option->get_positional() == positional && !option->get_group().empty();
  });
}

/// "-h,--help" or "problem"
std::string names_of(const CLI::Option& option) {
  return option.get_name(option.get_positional(), !option.get_positional());
}

/// Escapes text for a manual page: backslashes, hyphens that readers may copy, and control
/// characters at the beginning of a line.
std::string roff(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '\\') {
      escaped += "\\e";
    } else if (c == '-') {
      escaped += "\\-";
    } else if ((c == '.' || c == '\'') && (escaped.empty() || escaped.back() == '\n')) {
      escaped += std::string("\\&") + c;
    } else {
      escaped += c;
    }
  }
  return escaped;
}

void write_option(const CLI::Option& option, std::string& page) {
  page += fmt::format(".TP\n\\fB{}\\fR", roff(names_of(option)));
  if (!option.get_positional() && !is_flag(option)) {
    page += fmt::format(" \\fI{}\\fR", roff(option.get_type_name()));
  }
  page += '\n' + roff(option.get_description());
  if (!option.get_default_str().empty()) {
    page += fmt::format(" (default: {})", roff(option.get_default_str()));
  }
  page += '\n';
}

void write_command(const CLI::App& command, std::string& page) {
  page += fmt::format(".SS \"maxwrench {}", command.get_name());
  for (const CLI::Option* option : options_of(command, true)) {
    page += ' ' + (option->get_required() ? names_of(*option) : '[' + names_of(*option) + ']');
  }
  page += fmt::format(" [options]\"\n{}\n", roff(command.get_description()));
  for (const bool positional : {true, false}) {
    for (const CLI::Option* option : options_of(command, positional)) {
      if (option->get_name() != "--help") write_option(*option, page);
    }
  }
}

/// The names that an option accepts, if there are only a few.
std::string choices(const std::string& option) {
  std::string names;
  const auto add = [&names](const auto& table) {
    for (const auto& entry : table) {
      const bool listed = (' ' + names + ' ').find(fmt::format(" {} ", entry.name)) < names.size();
      if (!listed) names += std::string(names.empty() ? "" : " ") + entry.name;
    }
  };
  if (option == "--measure") add(measures());
  if (option == "--solver") {
    add(wrench_solvers());
    add(trajectory_solvers());
  }
  if (option == "--search") {
    add(searches());
    add(trajectory_searches());
    add(facet_searches());
    add(path_searches());
    add(transfer_searches());
  }
  if (option == "--integrator") add(integrators());
  if (option == "--wrench") names = "pure any";
  if (option == "problem" || option == "robot") {
    names = fmt::format("{}", fmt::join(shipped_problems(), " "));
  }
  return names;
}

/// The lines of a shell's `case` that set the completions of a command.
std::string completions(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : options_of(command, false)) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  std::string arguments;
  for (const CLI::Option* option : options_of(command, true)) {
    arguments += choices(option->get_name(true));
  }
  return fmt::format("    {}) options='{}' arguments='{}' ;;\n", command.get_name(),
                     fmt::join(names, " "), arguments);
}

constexpr const char* kBashEnd = R"(  esac
  if [[ $current == -* ]]; then
    COMPREPLY=($(compgen -W "$options" -- "$current"))
  else
    COMPREPLY=($(compgen -W "$arguments" -- "$current") $(compgen -f -- "$current"))
  fi
}
complete -o filenames -F _maxwrench maxwrench
)";

}  // namespace

std::string man_page(const CLI::App& app) {
  std::string page = fmt::format(
      ".TH MAXWRENCH 1 \"\" \"maxwrench {}\" \"User Commands\"\n"
      ".SH NAME\nmaxwrench \\- {}\n"
      ".SH SYNOPSIS\n.B maxwrench\n\\fIcommand\\fR [\\fIargument\\fR] [\\fIoptions\\fR]\n"
      ".SH DESCRIPTION\n{}\n.PP\n"
      "Results go to standard output, messages and progress to standard error.\n.SH COMMANDS\n",
      roff(version()), "how strongly a redundant robot can push, lift or twist",
      roff(app.get_description()));
  for (const CLI::App* command : shown_subcommands(app)) write_command(*command, page);
  return page +
         ".SH EXIT STATUS\n"
         ".TP\n0\nsuccess\n"
         ".TP\n1\nno optimum, or a rejected claim: the reason is printed\n"
         ".TP\n2\nbad input: one line names it and what was expected\n"
         ".SH ENVIRONMENT\n.TP\n.B MAXWRENCH_PROBLEMS\n"
         "the folder of the shipped problems (default: share/maxwrench/problems beside the folder "
         "of the command)\n";
}

std::string bash_completion(const CLI::App& app) {
  std::vector<std::string> names;
  std::string values, commands;
  for (const CLI::App* command : shown_subcommands(app)) {
    names.push_back(command->get_name());
    commands += completions(*command);
  }
  for (const char* option : {"--measure", "--solver", "--search", "--integrator", "--wrench"}) {
    values += fmt::format("    {}) COMPREPLY=($(compgen -W '{}' -- \"$current\")); return ;;\n",
                          option, choices(option));
  }
  return fmt::format(
             "_maxwrench() {{\n"
             "  local current=${{COMP_WORDS[COMP_CWORD]}} options= arguments=\n"
             "  if [[ $COMP_CWORD -eq 1 ]]; then\n"
             "    COMPREPLY=($(compgen -W '{} --help --version' -- \"$current\"))\n"
             "    return\n"
             "  fi\n"
             "  case ${{COMP_WORDS[COMP_CWORD - 1]}} in\n{}  esac\n"
             "  case ${{COMP_WORDS[1]}} in\n{}",
             fmt::join(names, " "), values, commands) +
         kBashEnd;
}

void add_manual(CLI::App& app, int& exit_status) {
  auto kind = std::make_shared<std::string>();
  CLI::App& command =
      *app.add_subcommand("manual", "prints the manual page or the bash completion");
  command.group("");  // for packages, not for users
  command.add_option("kind", *kind, "man or bash")
      ->required()
      ->check(CLI::IsMember({"man", "bash"}));
  command.callback([&app, kind, &exit_status] {
    fmt::print("{}", *kind == "man" ? man_page(app) : bash_completion(app));
    exit_status = kAnswered;
  });
}

}  // namespace maxwrench
