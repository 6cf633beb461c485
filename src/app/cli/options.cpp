#include "app/cli/options.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/base/param_table.hpp"
#include "fascicle/base/suggest.hpp"

#include <cmath>

namespace fascicle::app {

namespace {

CLI::Option* add_one(CLI::App& app, const std::string& name, const std::string& type,
                     const std::string& meaning, const std::function<void(const std::string&)>& read) {
    return add_reader(app, name, type, meaning, false, read);
}

std::string join(const std::vector<std::string>& words, const char* between) {
    std::string text;
    for (const std::string& word : words)
        text += (text.empty() ? "" : between) + word;
    return text;
}

} // namespace

CLI::Option* add_reader(CLI::App& app, const std::string& name, const std::string& type,
                        const std::string& meaning, bool repeatable,
                        const std::function<void(const std::string&)>& read) {
    const auto take = [name, type, repeatable, read](const std::vector<std::string>& texts) {
        if (texts.size() > 1 && !repeatable)
            throw_error(name, "given " + std::to_string(texts.size()) + " times", "it once",
                        ErrorKind::usage);
        for (const std::string& text : texts) {
            // CLI11 takes whatever follows an option as its value.
            if (text.empty() || text.starts_with("--"))
                throw_error(name, text.empty() ? "got an empty value" : "got '" + text + "'", type,
                            ErrorKind::usage);
            read(text);
        }
    };
    // Always a list, so that an option given twice comes here. Only an endless list gets dots in the help, and only a
    // nearly endless one takes a single value per occurrence: the next word may be an operand.
    const int most_given = CLI::detail::expected_max_vector_size - 1;
    CLI::Option* option = app.add_option_function<std::vector<std::string>>(name, take, meaning)
                              ->type_name(type)
                              ->allow_extra_args(false);
    return repeatable ? option : option->expected(1, most_given);
}

CLI::Option* add_text(CLI::App& app, const std::string& name, std::string& target, const std::string& type,
                      const std::string& meaning) {
    return add_one(app, name, type, meaning, [&target](const std::string& text) { target = text; });
}

CLI::Option* add_texts(CLI::App& app, const std::string& name, std::vector<std::string>& target,
                       const std::string& type, const std::string& meaning) {
    return add_reader(app, name, type, meaning, true,
                      [&target](const std::string& text) { target.push_back(text); });
}

CLI::Option* add_whole(CLI::App& app, const std::string& name, int& target, int low, int high,
                       const std::string& type, const std::string& meaning) {
    return add_one(app, name, type, meaning, [name, low, high, &target](const std::string& text) {
        target = read_whole(name, text, low, high);
    });
}

CLI::Option* add_number(CLI::App& app, const std::string& name, double& target, const std::string& type,
                        const std::string& meaning) {
    return add_one(app, name, type, meaning, [name, &target](const std::string& text) {
        target = read_numbers(name, text, ',', 1, "a number").front();
    });
}

CLI::Option* add_choice(CLI::App& app, const std::string& name, std::string& target,
                        const std::vector<std::string>& choices, const std::string& meaning) {
    const auto read = [name, choices, &target](const std::string& text) {
        if (std::find(choices.begin(), choices.end(), text) == choices.end())
            throw_error(name, "got '" + text + "'" + did_you_mean(text, choices),
                        "one of " + join(choices, ", "), ErrorKind::usage);
        target = text;
    };
    return add_one(app, name, join(choices, "|"), meaning, read);
}

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts;
    std::size_t start = 0;
    for (std::size_t end; (end = text.find(separator, start)) != std::string::npos; start = end + 1)
        parts.push_back(text.substr(start, end - start));
    parts.push_back(text.substr(start));
    return parts;
}

std::vector<double> read_numbers(const std::string& option, const std::string& text, char separator,
                                 std::size_t count, const std::string& expected) {
    std::vector<double> numbers;
    for (const std::string& part : split(text, separator)) {
        const std::size_t first = part.find_first_not_of(' '), last = part.find_last_not_of(' ');
        double number = 0;
        if (first == std::string::npos || !parse_number(part.substr(first, last - first + 1), number))
            throw_error(option, "got '" + text + "'", expected, ErrorKind::usage);
        numbers.push_back(number);
    }
    if (numbers.size() != count)
        throw_error(option, "got '" + text + "'", expected, ErrorKind::usage);
    return numbers;
}

int read_whole(const std::string& option, const std::string& text, int low, int high) {
    double number = 0;
    if (!parse_number(text, number) || number != std::floor(number) || number < low || number > high)
        throw_error(option, "got '" + text + "'",
                    "a whole number from " + std::to_string(low) + " to " + std::to_string(high),
                    ErrorKind::usage);
    return static_cast<int>(number);
}

} // namespace fascicle::app
