#include "mote/app/commands/command.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <new>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "mote/app/files/text.hpp"
#include "mote/app/terminal/shell.hpp"
#include "mote/app/terminal/signals.hpp"
#include "mote/app/terminal/suggestion.hpp"

namespace mote {
namespace {

/// "-n,--particles" -> "--particles".
std::string long_flag(const std::string& flags) { return flags.substr(flags.find("--")); }

/// The command line as a shell takes it again; the program by its name.
std::string shell_line(int count, char** words) {
  std::string line = "mote";
  for (int i = 1; i < count; ++i) line += ' ' + shell_word(words[i]);
  return line;
}

/// A command bound to CLI11, with a place for what is given.
struct Bound {
  Command command;
  CLI::App* app = nullptr;
  std::map<std::string, std::vector<std::string>> values;
  std::map<std::string, CLI::Option*> options;

  std::vector<std::string> flags() const {
    std::vector<std::string> all{"--help"};
    for (const OptionSpec& spec : command.options) all.push_back(long_flag(spec.flags));
    return all;
  }

  /// What follows an option: "N", "FILE"; empty for a flag.
  std::string value_of(const std::string& flag) const {
    for (const OptionSpec& spec : command.options)
      if (long_flag(spec.flags) == flag) return spec.value;
    return "";
  }

  Arguments arguments(const std::string& where, const std::string& command_line) const {
    std::map<std::string, std::vector<std::string>> given;
    std::map<std::string, std::string> fallbacks;
    for (const auto& [name, option] : options)
      if (option->count() > 0) given[name] = values.at(name);
    for (const OptionSpec& spec : command.options) fallbacks[long_flag(spec.flags)] = spec.fallback;
    return {where, command_line, std::move(given), std::move(fallbacks)};
  }
};

RefusalText nothing_for(const std::string& where, const std::string& what, const std::string& expected) {
  return {where, what, expected, "nothing", "See " + where + " --help."};
}

/// Refuses a word that no option takes, by the option it may have meant.
void refuse_leftovers(const std::vector<std::string>& words, const std::string& where,
                      const std::vector<std::string>& known) {
  if (words.empty()) return;
  const std::string help = "See " + where + " --help.";
  const auto dashed = std::find_if(words.begin(), words.end(), [](const auto& w) { return w.starts_with("-"); });
  if (dashed == words.end())
    throw Refusal(ExitCode::kWrongUse,
                  {where, "", "no further word", "\"" + words.front() + "\"",
                   words.front().find('=') == std::string::npos ? help : "Pass --set before every name=value."});
  const std::string flag = dashed->substr(0, dashed->find('='));
  const bool is_known = std::find(known.begin(), known.end(), flag) != known.end();
  throw Refusal(ExitCode::kWrongUse, {where, "", "an option of " + where, "\"" + flag + "\"",
                                      is_known ? "Pass it before the word --." : hint(flag, known, help)});
}

/// Refuses what the parser lets through: words left over, options with an empty value, flags with a value.
void check_words(const Bound& bound, const std::string& where) {
  refuse_leftovers(bound.app->remaining(), where, bound.flags());
  refuse_leftovers(bound.app->get_parent()->remaining(), where, bound.flags());  // words after --
  for (const auto& [name, option] : bound.options) {
    const std::string value = bound.value_of(name);
    const bool is_flag = name.starts_with("--") && value.empty();
    for (const std::string& given : option->results()) {
      if (is_flag && given != "true")
        throw Refusal(ExitCode::kWrongUse,
                      {where, name, "no value", "\"" + given + "\"", "Pass " + name + ", or leave it out."});
      if (!is_flag && given.empty())
        throw Refusal(ExitCode::kWrongUse, nothing_for(where, name, value.empty() ? "a name" : value));
    }
  }
}

/// A command "design measure" is a part of the command "design", which is bound before it.
void bind(CLI::App& program, Bound& bound) {
  const std::string& whole = bound.command.name;
  const std::size_t part = whole.find(' ');
  CLI::App& home = part == std::string::npos ? program : *program.get_subcommand(whole.substr(0, part));
  bound.app = home.add_subcommand(whole.substr(part + 1), bound.command.summary);
  bound.app->footer(bound.command.footer);
  bound.app->allow_extras();  // check_words() refuses them better
  for (const PositionalSpec& spec : bound.command.positionals) {
    CLI::Option* option = bound.app->add_option(spec.name, bound.values[spec.name], spec.meaning);
    option->expected(spec.many ? -1 : 1)->type_name("")->allow_extra_args(spec.many);
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

/// A parse error as a refusal that names the word.
Refusal refusal_for(const CLI::ParseError& error, const Bound* bound, const std::string& where) {
  const std::string text = error.what();
  if (bound != nullptr && error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ArgumentMismatch)) {
    const std::string flag = text.substr(0, text.find(':'));
    if (const std::string value = bound->value_of(flag); !value.empty())
      return {ExitCode::kWrongUse, nothing_for(where, flag, value)};
  }
  if (bound != nullptr && error.get_exit_code() == static_cast<int>(CLI::ExitCodes::RequiredError))
    for (const PositionalSpec& spec : bound->command.positionals)
      if (text.starts_with(spec.name)) return {ExitCode::kWrongUse, nothing_for(where, spec.name, spec.meaning)};
  return {ExitCode::kWrongUse, fmt::format("{}: {}. See {} --help.", where, text, where)};
}

int refused(const std::string& sentence, ExitCode code) {
  if (sentence.empty()) return static_cast<int>(code);  // another rank of the team says it
  std::fputs((printable(sentence) + "\n").c_str(), stderr);
  return static_cast<int>(code);
}

/// The same, but for wrong use, which all that mpirun started by the same words come to.
int refused_once(const Refusal& refusal, const std::function<bool()>& speaks) {
  const bool said = refusal.code() != ExitCode::kWrongUse || speaks();
  return refused(said ? refusal.what() : "", refusal.code());
}

int refused_output(int error) {
  return refused(Refusal(ExitCode::kCannotWrite, {"standard output", "", "an output that can be written",
                                                  std::strerror(error), "Check where it leads."})
                     .what(),
                 ExitCode::kCannotWrite);
}

/// Refuses words that stop before a command, or name none: of the program, or of a command that has parts.
void refuse_without_command(const std::vector<std::string>& words, const std::string& where,
                            const std::vector<std::string>& names, const std::vector<std::string>& flags) {
  const std::string known = fmt::format("one of {}", fmt::join(names, ", "));
  if (!words.empty() && !words.front().starts_with("-"))
    throw Refusal(ExitCode::kWrongUse, {where, "COMMAND", known, "\"" + words.front() + "\"",
                                        hint(words.front(), names, "See " + where + " --help.")});
  refuse_leftovers(words, where, flags);
  throw Refusal(ExitCode::kWrongUse, nothing_for(where, "COMMAND", known));
}

/// What a command printed may still be on its way; a reader or a disk may refuse it.
int with_printed(int code) {
  if (std::fflush(stdout) == 0 || code != 0) return code;
  return refused_output(errno);
}

int performed(const Bound& bound, const std::string& where, const std::string& command_line,
              const std::function<bool()>& speaks) {
  try {
    check_words(bound, where);
    return with_printed(static_cast<int>(bound.command.run(bound.arguments(where, command_line))));
  } catch (const Refusal& refusal) {
    return refused_once(refusal, speaks);
  } catch (const std::bad_alloc&) {
    return refused(where + ": the memory did not suffice. Pass fewer --particles, or less data.", ExitCode::kWrongUse);
  } catch (const std::exception& error) {
    const int number = errno;
    if (std::ferror(stdout) != 0) return refused_output(number);
    return refused(fmt::format("{}: a fault of mote itself: {}. Please report it.", where, error.what()),
                   static_cast<ExitCode>(1));
  }
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

std::string Arguments::pass_default(const std::string& name) const {
  const auto found = fallbacks_.find(name);
  return found == fallbacks_.end() || found->second.empty() ? fmt::format("Leave {} out for its default.", name)
                                                            : fmt::format("Pass {} {}.", name, found->second);
}

long long Arguments::integer(const std::string& name, long long least, long long most, const std::string& other) const {
  const std::string given = text(name);
  const auto value = integer_in(given);
  if (!value || *value < least || *value > most)
    throw Refusal(ExitCode::kWrongUse, {where_, name, fmt::format("{}an integer from {} to {}", other, least, most),
                                        given, pass_default(name)});
  return *value;
}

double Arguments::number(const std::string& name, double least, double most) const {
  const std::string given = text(name);
  const auto value = number_in(given);
  if (!value || !(*value >= least && *value <= most))
    throw Refusal(ExitCode::kWrongUse,
                  {where_, name, fmt::format("a number from {} to {}", least, most), given, pass_default(name)});
  return *value;
}

std::size_t Arguments::choice(const std::string& name, const std::vector<std::string>& choices) const {
  const std::string given = text(name);
  const auto found = std::find(choices.begin(), choices.end(), given);
  if (found == choices.end())
    throw Refusal(ExitCode::kWrongUse, {where_, name, fmt::format("one of {}", fmt::join(choices, ", ")),
                                        "\"" + given + "\"", hint(given, choices, pass_default(name))});
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
    throw refusal_for(error, &bound, where);
  }
  check_words(bound, where);
  return bound.arguments(where, where);
}

int run_program(int count, char** words, const std::vector<Command>& commands_known,
                const std::function<bool()>& speaks) {
  occupy_closed_streams();
  let_writes_fail();
  CLI::App program("mote: particle filters, from the model to the machine", "mote");
  program.set_version_flag("--version", "mote " MOTE_VERSION);
  program.require_subcommand(0, 1);
  program.allow_extras();
  program.get_formatter()->column_width(38);
  std::vector<std::unique_ptr<Bound>> commands;
  std::vector<std::string> names;
  for (const Command& command : commands_known) {
    commands.push_back(std::make_unique<Bound>());
    if (command.name.find(' ') == std::string::npos) names.push_back(command.name);
    commands.back()->command = command;
    bind(program, *commands.back());
  }
  const auto asked = [&]() -> const Bound* {
    const auto last =
        std::find_if(commands.rbegin(), commands.rend(), [](const auto& bound) { return bound->app->parsed(); });
    return last == commands.rend() ? nullptr : last->get();  // a part comes after its command
  };
  const auto parts_of = [&](const Bound& bound) {
    std::vector<std::string> parts;
    for (const CLI::App* part : bound.app->get_subcommands({})) parts.push_back(part->get_name());
    return parts;
  };
  try {
    try {
      program.parse(count, words);
    } catch (const CLI::ParseError& error) {
      if (error.get_exit_code() == 0) return with_printed(program.exit(error));  // --help, --version
      throw refusal_for(error, asked(), asked() == nullptr ? "mote" : "mote " + asked()->command.name);
    }
    const std::vector<std::string> before = program.remaining();
    if (asked() == nullptr || (!before.empty() && !before.front().starts_with("-")))
      refuse_without_command(before, "mote", names, {"--help", "--version"});
    if (!asked()->command.run)
      refuse_without_command(asked()->app->remaining(), "mote " + asked()->command.name, parts_of(*asked()),
                             {"--help"});
  } catch (const Refusal& refusal) {
    return refused_once(refusal, speaks);
  }
  return performed(*asked(), "mote " + asked()->command.name, shell_line(count, words), speaks);
}

}  // namespace mote
