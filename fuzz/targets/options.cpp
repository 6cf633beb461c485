// The command line, and the texts of single options.

#include "app/cli/command_line.hpp"
#include "fascicle/io/load_scene.hpp"
#include "fascicle/io/osim_request.hpp"
#include "fascicle/solver/parameters.hpp"
#include "fuzz/check.hpp"
#include "fuzz/targets.hpp"
#include "io/formats/text_scanner.hpp"

#include <cmath>

namespace fascicle::fuzz {
namespace {

constexpr std::size_t most_words = 64;

std::vector<std::string> words_of(std::string_view bytes, char separator) {
    std::vector<std::string> words;
    while (words.size() < most_words) {
        const std::size_t end = std::min(bytes.find(separator), bytes.size());
        words.emplace_back(bytes.substr(0, end));
        if (end == bytes.size())
            break;
        bytes.remove_prefix(end + 1);
    }
    return words;
}

void check_usage(const std::function<void()>& parse) {
    try {
        parse();
    } catch (const Error& error) {
        check_message(error, {});
        FUZZ_CHECK(error.kind() == ErrorKind::usage);
    }
}

} // namespace

/// A word a line.
void fuzz_command_line(std::string_view bytes) {
    std::vector<std::string> words = words_of(bytes, '\n');
    words.insert(words.begin(), "fascicle");
    std::vector<char*> argv;
    for (std::string& word : words)
        argv.push_back(word.data());
    argv.push_back(nullptr);
    check_usage(
        [&] { FUZZ_CHECK(app::parse_command_line(static_cast<int>(words.size()), argv.data()) != nullptr); });
}

void fuzz_options(std::string_view bytes) {
    const std::string text(bytes);
    check_usage([&] {
        const HingeRequest hinge = parse_hinge(text);
        FUZZ_CHECK(std::abs(hinge.axis.norm() - 1) < 1e-9);
        FUZZ_CHECK(!hinge.centre || hinge.centre->allFinite());
    });
    check_usage([&] {
        const Phases phases = parse_phases(text);
        FUZZ_CHECK(phases.out >= 0 && phases.back >= 0 && phases.rest >= 0 && phases.total() > 0);
    });
    check_usage([&] { parse_unit(text); });
    check_usage([&] {
        const auto [name, file] = parse_named_file("--attachments", text);
        FUZZ_CHECK(!name.empty() && !file.empty());
    });
    check_usage([&] { parse_mesh_frame(text); });
    check_usage([&] { FUZZ_CHECK(*axis_mapping_key(parse_axis_mapping(text)) != 0); });
    check_usage([&] { FUZZ_CHECK(!parse_mesh_of_bodies("--muscle", text).mesh.empty()); });
    double number = 0;
    if (parse_number(text, number)) {
        double back = 0;
        FUZZ_CHECK(std::isfinite(number) && parse_number(number_text(number), back) && back == number);
    }
    if (io::to_double(text, number) == io::NumberCheck::ok && std::isfinite(number)) {
        double back = 0;
        FUZZ_CHECK(io::to_double(number_text(number), back) == io::NumberCheck::ok && back == number);
    }
    long long whole = 0;
    if (io::to_integer(text, whole) == io::NumberCheck::ok) {
        long long back = 0;
        FUZZ_CHECK(io::to_integer(std::to_string(whole), back) == io::NumberCheck::ok && back == whole);
    }
}

/// A KEY=VALUE a line, as --set takes them.
void fuzz_parameters(std::string_view bytes) {
    static const ParamSet defaults = default_parameters();
    ParamSet parameters = defaults;
    for (const std::string& word : words_of(bytes, '\n'))
        check_usage([&] {
            const std::string method = "solver.method=";
            if (word.starts_with(method))
                set_method(parameters, word.substr(method.size()));
            else
                parameters.assign(word);
        });
    ParamSet again = defaults;
    set_method(again, parameters.get_choice("solver.method"));
    for (const ParamRow& row : parameters.table().rows()) {
        const double value = parameters.get(row.key);
        FUZZ_CHECK(value >= row.minimum && value <= row.maximum);
        if (parameters.edited(row.key))
            again.set_text(row.key, parameters.text(row.key));
    }
    FUZZ_CHECK(again == parameters);
}

} // namespace fascicle::fuzz
