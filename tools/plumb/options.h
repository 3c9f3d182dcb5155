// The options of one subcommand, as it declares them.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace plumb::tool {

/// Declares arguments and options. Each is bound to a variable that must live until the command has
/// run; options that are not given leave theirs alone. `names` is "--size" or "-o,--output";
/// `placeholder` stands for the value in the help.
class Options {
 public:
  struct Parser;
  explicit Options(Parser& parser) : parser_(parser) {}

  /// An argument without a dash, which must be given.
  void argument(std::string& into, const std::string& placeholder, const std::string& help);
  /// One that may be left out.
  void optional_argument(std::string& into, const std::string& placeholder,
                         const std::string& help);
  /// Any number of them.
  void optional_arguments(std::vector<std::string>& into, const std::string& placeholder,
                          const std::string& help);
  /// One or more of them.
  void arguments(std::vector<std::string>& into, const std::string& placeholder,
                 const std::string& help);

  void text(std::string& into, const std::string& names, const std::string& placeholder,
            const std::string& help);
  /// An option that may be given several times.
  void texts(std::vector<std::string>& into, const std::string& names,
             const std::string& placeholder, const std::string& help);
  /// One of a few words; anything else is an error that lists them.
  void choice(std::string& into, const std::string& names, const std::vector<std::string>& words,
              const std::string& help);
  void integer(int& into, const std::string& names, const std::string& placeholder,
               const std::string& help, int least, int most);
  void number(double& into, const std::string& names, const std::string& placeholder,
              const std::string& help);
  void number(std::optional<double>& into, const std::string& names, const std::string& placeholder,
              const std::string& help);
  void flag(bool& into, const std::string& names, const std::string& help);
  /// Must be given.
  void require_option(const std::string& name);
  /// Options declared from here on stand under this heading of the help.
  void group(const std::string& heading);

 private:
  Parser& parser_;
};

}  // namespace plumb::tool
