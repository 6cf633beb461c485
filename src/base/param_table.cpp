#include "fascicle/base/param_table.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/base/suggest.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace fascicle {

namespace {

std::vector<std::string> keys(const ParamTable& table) {
    std::vector<std::string> list;
    for (const ParamRow& row : table.rows())
        list.push_back(row.key);
    return list;
}

} // namespace

ParamTable::ParamTable(std::vector<ParamRow> rows) : rows_(std::move(rows)) {}

const ParamRow* ParamTable::find(std::string_view key) const {
    const auto it =
        std::find_if(rows_.begin(), rows_.end(), [&](const ParamRow& row) { return row.key == key; });
    return it == rows_.end() ? nullptr : &*it;
}

std::size_t ParamTable::index(std::string_view key) const {
    const ParamRow* row = find(key);
    FASCICLE_ASSERT(row != nullptr);
    return static_cast<std::size_t>(row - rows_.data());
}

ParamSet::ParamSet(const ParamTable& table) : table_(&table), edited_(table.rows().size(), false) {
    for (const ParamRow& row : table.rows())
        defaults_.push_back(row.default_value);
    values_ = defaults_;
}

double ParamSet::get(std::string_view key) const {
    return values_[table_->index(key)];
}

const std::string& ParamSet::get_choice(std::string_view key) const {
    const std::size_t i = table_->index(key);
    return table_->rows()[i].choices.at(static_cast<std::size_t>(values_[i]));
}

bool ParamSet::edited(std::string_view key) const {
    return edited_[table_->index(key)];
}

void ParamSet::check(const ParamRow& row, double value, std::string_view shown) const {
    const bool whole = row.kind == ParamKind::real || value == std::floor(value);
    if (!std::isfinite(value) || value < row.minimum || value > row.maximum || !whole)
        throw_error(row.key, "bad value '" + std::string(shown) + "'",
                    std::string(row.kind == ParamKind::real ? "a number" : "a whole number") + " from " +
                        number_text(row.minimum) + " to " + number_text(row.maximum) +
                        (row.unit == "1" ? "" : " " + row.unit),
                    ErrorKind::usage);
}

void ParamSet::set(std::string_view key, double value) {
    const ParamRow* row = table_->find(key);
    if (row == nullptr)
        throw_error("parameter '" + std::string(key) + "'",
                    "no such parameter" + did_you_mean(key, keys(*table_)), "a key of docs/parameters.md",
                    ErrorKind::usage);
    check(*row, value, number_text(value));
    const std::size_t i = table_->index(key);
    values_[i] = value;
    edited_[i] = true;
}

void ParamSet::set_text(std::string_view key, std::string_view text) {
    const ParamRow* row = table_->find(key);
    double value = 0;
    if (row != nullptr && row->kind == ParamKind::choice) {
        const auto it = std::find(row->choices.begin(), row->choices.end(), text);
        if (it == row->choices.end()) {
            std::string known;
            for (const std::string& choice : row->choices)
                known += (known.empty() ? "" : ", ") + choice;
            throw_error(row->key, "bad value '" + std::string(text) + "'", "one of " + known,
                        ErrorKind::usage);
        }
        value = double(it - row->choices.begin());
    } else if (row != nullptr && !parse_number(text, value)) {
        check(*row, std::nan(""), text);
    }
    set(key, value);
}

void ParamSet::assign(std::string_view key_equals_value) {
    const std::size_t equals = key_equals_value.find('=');
    if (equals == std::string_view::npos)
        throw_error("--set", "got '" + std::string(key_equals_value) + "'", "KEY=VALUE", ErrorKind::usage);
    set_text(key_equals_value.substr(0, equals), key_equals_value.substr(equals + 1));
}

void ParamSet::reset(std::string_view key) {
    const std::size_t i = table_->index(key);
    values_[i] = defaults_[i];
    edited_[i] = false;
}

void ParamSet::keep_defaults(const std::string& method, Defaults defaults) {
    kept_[method] = std::move(defaults);
}

const ParamSet::Defaults* ParamSet::kept_defaults(const std::string& method) const {
    const auto it = kept_.find(method);
    return it == kept_.end() ? nullptr : &it->second;
}

void ParamSet::set_defaults(const Defaults& defaults) {
    for (std::size_t i = 0; i < values_.size(); ++i) {
        const ParamRow& row = table_->rows()[i];
        const auto it = defaults.find(row.key);
        defaults_[i] = it == defaults.end() ? row.default_value : it->second;
        if (!edited_[i])
            values_[i] = defaults_[i];
    }
}

double ParamSet::default_value(std::string_view key) const {
    return defaults_[table_->index(key)];
}

std::string ParamSet::text(std::string_view key) const {
    const ParamRow& row = table_->rows()[table_->index(key)];
    return row.kind == ParamKind::choice ? get_choice(key) : number_text(get(key));
}

std::string number_text(double value) {
    char buffer[40];
    const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
    return std::string(buffer, end);
}

bool parse_number(std::string_view text, double& value) {
    if (!text.empty() && text.front() == '+')
        text.remove_prefix(1);
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    return code == std::errc() && end == text.data() + text.size() && std::isfinite(value);
}

} // namespace fascicle
