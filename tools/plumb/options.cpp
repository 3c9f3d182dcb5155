// The only file that knows the library that reads command lines.
#include "options.h"

#include <CLI/CLI.hpp>

#include <fmt/ranges.h>

#include <memory>

#include "command.h"
#include "core/check.h"
#include "core/number_text.h"

namespace plumb::tool {

struct Options::Parser {
  CLI::App* app = nullptr;
  std::string heading;

  CLI::Option* finish(CLI::Option* option, const std::string& placeholder) const {
    option->type_name(placeholder);
    if (!heading.empty()) option->group(heading);
    return option;
  }
};

namespace {

// "--size" from "-s,--size".
std::string long_name(const std::string& names) {
  return names.substr(names.find_last_of(',') == std::string::npos ? 0
                                                                   : names.find_last_of(',') + 1);
}

double number_or_error(const std::string& text, const std::string& name) {
  const std::optional<double> value = parse_number(text);
  if (!value) input_error("{} '{}': expected a number", name, text);
  return *value;
}

// Names the place that tells more, and only there; a message is one line.
[[noreturn]] void usage_error(const std::string& message, const std::string& command) {
  const std::string place = command.empty() ? "plumb" : "plumb " + command;
  input_error("{} (see '{} --help')", message, place);
}

// What is said of an argument that nothing asked for.
std::string stray(const std::string& argument, const std::string& command,
                  const std::vector<Command>& commands) {
  if (argument.size() > 1 && argument[0] == '-')
    return fmt::format("unknown option '{}'", argument);
  if (!command.empty()) return fmt::format("unexpected argument '{}'", argument);
  std::vector<std::string> names;
  for (const Command& known : commands) names.push_back(known.name);
  return fmt::format("unknown command '{}', there are: {}", argument, fmt::join(names, ", "));
}

}  // namespace

void Options::argument(std::string& into, const std::string& placeholder, const std::string& help) {
  parser_.finish(parser_.app->add_option(placeholder, into, help), "")->required();
}

void Options::optional_argument(std::string& into, const std::string& placeholder,
                                const std::string& help) {
  parser_.finish(parser_.app->add_option(placeholder, into, help), "");
}

void Options::optional_arguments(std::vector<std::string>& into, const std::string& placeholder,
                                 const std::string& help) {
  parser_.finish(parser_.app->add_option(placeholder, into, help), "");
}

void Options::arguments(std::vector<std::string>& into, const std::string& placeholder,
                        const std::string& help) {
  parser_.finish(parser_.app->add_option(placeholder, into, help), "")->required();
}

void Options::text(std::string& into, const std::string& names, const std::string& placeholder,
                   const std::string& help) {
  parser_.finish(parser_.app->add_option(names, into, help), placeholder);
}

void Options::texts(std::vector<std::string>& into, const std::string& names,
                    const std::string& placeholder, const std::string& help) {
  parser_.finish(parser_.app->add_option(names, into, help), placeholder)->allow_extra_args(false);
}

void Options::choice(std::string& into, const std::string& names,
                     const std::vector<std::string>& words, const std::string& help) {
  const auto check = [words, name = long_name(names)](const std::string& text) {
    for (const std::string& word : words) {
      if (text == word) return std::string();
    }
    return fmt::format("'{}': expected {}", text, fmt::join(words, ", "));
  };
  parser_
      .finish(parser_.app->add_option(names, into, help), fmt::format("{}", fmt::join(words, "|")))
      ->check(check);
}

void Options::integer(int& into, const std::string& names, const std::string& placeholder,
                      const std::string& help, int least, int most) {
  const auto store = [&into, name = long_name(names), least, most](const std::string& text) {
    const std::optional<std::int64_t> value = parse_integer(text);
    if (!value || *value < least || *value > most)
      input_error("{} '{}': expected a whole number from {} to {}", name, text, least, most);
    into = static_cast<int>(*value);
  };
  parser_.finish(parser_.app->add_option_function<std::string>(names, store, help), placeholder);
}

void Options::number(double& into, const std::string& names, const std::string& placeholder,
                     const std::string& help) {
  const auto store = [&into, name = long_name(names)](const std::string& text) {
    into = number_or_error(text, name);
  };
  parser_.finish(parser_.app->add_option_function<std::string>(names, store, help), placeholder);
}

void Options::number(std::optional<double>& into, const std::string& names,
                     const std::string& placeholder, const std::string& help) {
  const auto store = [&into, name = long_name(names)](const std::string& text) {
    into = number_or_error(text, name);
  };
  parser_.finish(parser_.app->add_option_function<std::string>(names, store, help), placeholder);
}

void Options::flag(bool& into, const std::string& names, const std::string& help) {
  CLI::Option* option = parser_.app->add_flag(names, into, help);
  if (!parser_.heading.empty()) option->group(parser_.heading);
}

void Options::require_option(const std::string& name) { parser_.app->get_option(name)->required(); }

void Options::group(const std::string& heading) { parser_.heading = heading; }

Request read_command_line(const std::vector<Command>& commands, const Invocation& invocation) {
  CLI::App app("Audits how truly a terrain renderer draws its terrain.", "plumb");
  app.footer("'plumb COMMAND --help' tells more of a command and has an example.");
  Request request;
  app.add_flag("--version", request.version, "Print the version and what it was built with");
  app.add_flag("--json", request.json, "With --version: one JSON object")->needs("--version");
  app.require_subcommand(0, 1);

  struct Declared {
    CLI::App* app;
    Action action;
    std::unique_ptr<Options::Parser> parser;
  };
  std::vector<Declared> declared;
  for (const Command& command : commands) {
    CLI::App* sub = app.add_subcommand(command.name, command.summary);
    sub->footer("Example:\n  " + command.example);
    auto parser = std::make_unique<Options::Parser>(Options::Parser{sub, ""});
    Options options(*parser);
    declared.push_back({sub, command.declare(options), std::move(parser)});
  }
  const auto chosen = [&]() -> std::string {
    const std::vector<CLI::App*> parsed = app.get_subcommands();
    return parsed.empty() ? "" : parsed.front()->get_name();
  };
  try {
    std::vector<std::string> backwards(invocation.arguments.rbegin(),
                                       invocation.arguments.rend() - 1);
    app.parse(backwards);
  } catch (const CLI::CallForHelp&) {
    request.answer = chosen().empty() ? app.help() : app.get_subcommand(chosen())->help("plumb");
    return request;
  } catch (const CLI::ParseError& error) {
    const std::vector<std::string> left = app.remaining(true);
    usage_error(left.empty() ? error.what() : stray(left.front(), chosen(), commands), chosen());
  }
  for (const Declared& entry : declared) {
    if (entry.app->parsed()) request.action = entry.action;
  }
  if (!request.action && !request.version) {
    if (invocation.arguments.size() > 1) usage_error("a command is missing", "");
    request.answer = app.help();
  }
  return request;
}

}  // namespace plumb::tool
