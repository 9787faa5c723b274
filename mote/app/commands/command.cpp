#include "mote/app/commands/command.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <new>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "mote/app/files/text.hpp"

namespace mote {
namespace {

/// "-n,--particles" -> "--particles".
std::string long_flag(const std::string& flags) { return flags.substr(flags.find("--")); }

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// The command line as a shell takes it again; the program by its name.
std::string shell_line(int count, char** words) {
  std::string line = "mote";
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    const bool plain =
        !word.empty() &&
        word.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_=./,:+%@") ==
            std::string::npos;
    line += ' ';
    if (plain) {
      line += word;
      continue;
    }
    line += '\'';
    for (const char c : word) line += c == '\'' ? "'\\''" : std::string(1, c);
    line += '\'';
  }
  return line;
}

/// A command bound to CLI11, with a place for what is given.
struct Bound {
  Command command;
  CLI::App* app = nullptr;
  std::map<std::string, std::vector<std::string>> values;
  std::map<std::string, CLI::Option*> options;

  Arguments arguments(const std::string& command_line) const {
    std::map<std::string, std::vector<std::string>> given;
    std::map<std::string, std::string> fallbacks;
    for (const auto& [name, option] : options)
      if (option->count() > 0) given[name] = values.at(name);
    for (const OptionSpec& spec : command.options) fallbacks[long_flag(spec.flags)] = spec.fallback;
    return {"mote " + command.name, command_line, std::move(given), std::move(fallbacks)};
  }
};

void bind(CLI::App& program, Bound& bound) {
  bound.app = program.add_subcommand(bound.command.name, bound.command.summary);
  bound.app->footer(bound.command.footer);
  for (const PositionalSpec& spec : bound.command.positionals) {
    CLI::Option* option = bound.app->add_option(spec.name, bound.values[spec.name], spec.meaning);
    option->expected(1)->type_name("")->allow_extra_args(false);
    if (spec.required) option->required();
    bound.options[spec.name] = option;
  }
  for (const OptionSpec& spec : bound.command.options) {
    const std::string name = long_flag(spec.flags);
    const std::string meaning = spec.meaning + (spec.fallback.empty() ? "" : " [" + spec.fallback + "]");
    CLI::Option* option = nullptr;
    if (spec.value.empty()) {
      option = bound.app->add_flag(spec.flags, meaning);
      bound.values[name] = {"true"};
    } else {
      option = bound.app->add_option(spec.flags, bound.values[name], meaning)->type_name(spec.value)->expected(1);
      option->multi_option_policy(spec.many ? CLI::MultiOptionPolicy::TakeAll : CLI::MultiOptionPolicy::TakeLast);
      option->allow_extra_args(false);
    }
    option->group(spec.group);
    bound.options[name] = option;
  }
}

/// A parse error as one sentence that names the word.
std::string sentence_for(const CLI::ParseError& error, const std::string& where) {
  return fmt::format("{}: {}. See {} --help.", where, one_line(error.what()), where);
}

int refused(const std::string& sentence, ExitCode code) {
  std::fputs((sentence + "\n").c_str(), stderr);
  return static_cast<int>(code);
}

int dispatched(const CLI::App& program, const std::vector<std::unique_ptr<Bound>>& commands,
               const std::string& command_line) {
  for (const auto& bound : commands) {
    if (!bound->app->parsed()) continue;
    try {
      return static_cast<int>(bound->command.run(bound->arguments(command_line)));
    } catch (const Refusal& refusal) {
      return refused(refusal.what(), refusal.code());
    } catch (const std::bad_alloc&) {
      return refused(fmt::format("mote {}: the memory did not suffice. Pass fewer --particles.", bound->command.name),
                     ExitCode::kWrongUse);
    } catch (const std::exception& error) {
      return refused(fmt::format("mote {}: {}", bound->command.name, error.what()), static_cast<ExitCode>(1));
    }
  }
  std::fputs(program.help().c_str(), stderr);
  return static_cast<int>(ExitCode::kWrongUse);
}

}  // namespace

std::string Arguments::text(const std::string& name) const {
  const auto found = given_.find(name);
  if (found != given_.end()) return found->second.back();
  const auto fallback = fallbacks_.find(name);
  return fallback == fallbacks_.end() ? "" : fallback->second;
}

std::vector<std::string> Arguments::list(const std::string& name) const {
  const auto found = given_.find(name);
  return found == given_.end() ? std::vector<std::string>{} : found->second;
}

long long Arguments::integer(const std::string& name, long long least, long long most) const {
  const std::string given = text(name);
  const auto value = integer_in(given);
  if (!value || *value < least || *value > most)
    throw Refusal(ExitCode::kWrongUse, {where_, name, fmt::format("an integer from {} to {}", least, most),
                                        given.empty() ? "nothing" : given,
                                        fallbacks_.contains(name) && !fallbacks_.at(name).empty()
                                            ? fmt::format("Pass {} {}.", name, fallbacks_.at(name))
                                            : ""});
  return *value;
}

double Arguments::number(const std::string& name, double least, double most) const {
  const std::string given = text(name);
  const auto value = number_in(given);
  if (!value || !(*value >= least && *value <= most))
    throw Refusal(ExitCode::kWrongUse, {where_, name, fmt::format("a number from {} to {}", least, most), given,
                                        fmt::format("Pass {} {}.", name, fallbacks_.at(name))});
  return *value;
}

std::size_t Arguments::choice(const std::string& name, const std::vector<std::string>& choices) const {
  const std::string given = text(name);
  const auto found = std::find(choices.begin(), choices.end(), given);
  if (found == choices.end())
    throw Refusal(ExitCode::kWrongUse, {where_, name, fmt::format("one of {}", fmt::join(choices, ", ")),
                                        "\"" + given + "\"", fmt::format("Pass {} {}.", name, choices.front())});
  return static_cast<std::size_t>(found - choices.begin());
}

std::string Arguments::required(const std::string& name, const std::string& expected, const std::string& next) const {
  std::string given = text(name);
  if (given.empty()) throw Refusal(ExitCode::kWrongUse, {where_, name, expected, "nothing", next});
  return given;
}

Arguments arguments_from(const std::string& where, const std::vector<OptionSpec>& options,
                         const std::vector<std::string>& words) {
  CLI::App program;
  Bound bound;
  bound.command = {"run", "", {}, options, nullptr, ""};
  bind(program, bound);
  std::vector<std::string> reversed(words.rbegin(), words.rend());
  reversed.emplace_back("run");
  try {
    program.parse(std::move(reversed));
  } catch (const CLI::ParseError& error) {
    throw Refusal(ExitCode::kWrongUse, where + ": " + one_line(error.what()) + ".");
  }
  return bound.arguments(where);
}

int run_program(int count, char** words) {
  CLI::App program("mote: particle filters, from the model to the machine", "mote");
  program.set_version_flag("--version", "mote " MOTE_VERSION);
  program.require_subcommand(0, 1);
  program.get_formatter()->column_width(38);
  std::vector<std::unique_ptr<Bound>> commands;
  for (Command command : {models_command(), simulate_command(), run_command(), reproduce_command()}) {
    commands.push_back(std::make_unique<Bound>());
    commands.back()->command = std::move(command);
    bind(program, *commands.back());
  }
  try {
    program.parse(count, words);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return program.exit(error);  // --help, --version
    std::string where = "mote";
    for (const auto& bound : commands)
      if (bound->app->parsed()) where += " " + bound->command.name;
    return refused(sentence_for(error, where), ExitCode::kWrongUse);
  }
  return dispatched(program, commands, shell_line(count, words));
}

}  // namespace mote
