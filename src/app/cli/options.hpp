#pragma once
// Options whose bad values are reported in the project's own words: option, what was given, what was
// expected.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace fascicle::app {

/// `--name TYPE`: hands the text to `read`, once per occurrence. Error (usage) when the text is empty or looks like an
/// option (a forgotten value), and when the option is given twice without being repeatable.
CLI::Option* add_reader(CLI::App& app, const std::string& name, const std::string& type,
                        const std::string& meaning, bool repeatable,
                        const std::function<void(const std::string&)>& read);

/// `--name TYPE`: any text that does not itself look like an option.
CLI::Option* add_text(CLI::App& app, const std::string& name, std::string& target, const std::string& type,
                      const std::string& meaning);
/// The same, may be given again and again.
CLI::Option* add_texts(CLI::App& app, const std::string& name, std::vector<std::string>& target,
                       const std::string& type, const std::string& meaning);
/// `--name N`: a whole number within [low, high].
CLI::Option* add_whole(CLI::App& app, const std::string& name, int& target, int low, int high,
                       const std::string& type, const std::string& meaning);
/// `--name X`: any finite number.
CLI::Option* add_number(CLI::App& app, const std::string& name, double& target, const std::string& type,
                        const std::string& meaning);
/// `--name A`: one of `choices`.
CLI::Option* add_choice(CLI::App& app, const std::string& name, std::string& target,
                        const std::vector<std::string>& choices, const std::string& meaning);

/// Text between separators; "a,,b" has an empty part, "" has one empty part.
std::vector<std::string> split(const std::string& text, char separator);
/// Numbers between separators. Error (usage) naming the option unless there are exactly `count` finite ones.
std::vector<double> read_numbers(const std::string& option, const std::string& text, char separator,
                                 std::size_t count, const std::string& expected);
/// A whole number within [low, high]. Error (usage) naming the option.
int read_whole(const std::string& option, const std::string& text, int low, int high);

} // namespace fascicle::app
