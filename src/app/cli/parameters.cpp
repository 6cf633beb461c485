// fascicle parameters: the parameter table, for the terminal or as docs/parameters.md.

#include "fascicle/solver/parameters.hpp"

#include "app/cli/command.hpp"
#include "fascicle/io/preset_file.hpp"
#include "fascicle/io/user_folder.hpp"
#include "fascicle/solver/soft_body_solver.hpp"

#include <CLI/CLI.hpp>
#include <iostream>

namespace fascicle::app {

namespace {

std::string range_text(const ParamRow& row) {
    if (row.kind != ParamKind::choice)
        return number_text(row.minimum) + " to " + number_text(row.maximum);
    std::string text;
    for (const std::string& choice : row.choices)
        text += (text.empty() ? "" : ", ") + choice;
    return text;
}

/// At most six digits: a default for people to read.
std::string short_text(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

/// "0.3", or "0.3 (classic 0.9)" where a method brings another default.
std::string default_text(const ParamRow& row) {
    const auto shown = [&](double value) {
        return row.kind == ParamKind::choice ? row.choices.at(static_cast<std::size_t>(value))
                                             : short_text(value);
    };
    std::string others;
    for (const SolverMethod& method : solver_methods())
        if (const auto own = method.defaults.find(row.key); own != method.defaults.end())
            others += (others.empty() ? " (" : ", ") + method.name + " " + shown(own->second);
    return shown(row.default_value) + others + (others.empty() ? "" : ")");
}

std::vector<std::string> cells(const ParamRow& row) {
    return {row.key, row.unit, range_text(row), default_text(row), row.meaning};
}

void print_plain(std::ostream& out) {
    std::vector<std::vector<std::string>> lines{{"key", "unit", "range", "default", "meaning"}};
    for (const ParamRow& row : parameter_table().rows())
        lines.push_back(cells(row));
    std::vector<std::size_t> widths(lines.front().size(), 0);
    for (const auto& line : lines)
        for (std::size_t i = 0; i < line.size(); ++i)
            widths[i] = std::max(widths[i], line[i].size());
    for (const auto& line : lines) {
        for (std::size_t i = 0; i + 1 < line.size(); ++i)
            out << line[i] << std::string(widths[i] - line[i].size() + 2, ' ');
        out << line.back() << '\n';
    }
}

/// A bar would end the cell of a Markdown table.
std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text)
        result += c == '|' ? "\\|" : std::string(1, c);
    return result;
}

void print_markdown(std::ostream& out) {
    out << "# Parameters\n\n"
           "Keys for `fascicle simulate --set KEY=VALUE` and for project files; the editor's tuning panel "
           "shows\n"
           "the same rows. Made by `fascicle parameters --markdown`; a test keeps this page and the program\n"
           "alike. Unit `1` is a plain number. A method may bring another default, given in brackets.\n\n"
           "| key | unit | range | default | meaning | source |\n"
           "| --- | --- | --- | --- | --- | --- |\n";
    for (const ParamRow& row : parameter_table().rows()) {
        const std::vector<std::string> line = cells(row);
        out << "| `" << row.key << '`';
        for (std::size_t i = 1; i < line.size(); ++i)
            out << " | " << escaped(line[i]);
        out << " | " << escaped(row.source) << " |\n";
    }
}

void print_presets(std::ostream& out) {
    std::vector<std::string> problems;
    std::vector<Preset> presets = built_in_presets();
    for (Preset& own : own_presets(presets_folder(user_folder()), problems))
        presets.push_back(std::move(own));
    for (const Preset& preset : presets) {
        out << preset.key << ": " << (preset.meaning.empty() ? preset.label : preset.meaning) << '\n';
        for (const auto& [key, text] : preset.values)
            out << "  " << key << '=' << text << '\n';
    }
    for (const std::string& problem : problems)
        std::cerr << "warning: " << problem << '\n';
}

} // namespace

std::function<int()> add_parameters(CLI::App& app) {
    const auto markdown = std::make_shared<bool>(false);
    app.add_flag("--markdown", *markdown, "Print docs/parameters.md instead of a plain table");
    const auto presets = std::make_shared<bool>(false);
    app.add_flag("--presets", *presets, "List the presets with their values instead");
    return [markdown, presets] {
        if (*presets)
            print_presets(std::cout);
        else
            *markdown ? print_markdown(std::cout) : print_plain(std::cout);
        return 0;
    };
}

} // namespace fascicle::app
