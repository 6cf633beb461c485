#pragma once
// Parameters as rows: one row feeds the project file, `--set`, the tuning panel and the summary. Keys never
// change; labels may.

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace fascicle {

enum class ParamKind { real, integer, choice };

struct ParamRow {
    std::string key;   ///< stable, e.g. "solver.stiffness"
    std::string label; ///< shown to people
    std::string unit;  ///< "1" when dimensionless
    ParamKind kind = ParamKind::real;
    double minimum = 0;
    double maximum = 1;
    double default_value = 0;
    std::vector<std::string> choices; ///< kind choice: value is the index
    std::string meaning;              ///< one sentence for the tooltip
    std::string source;               ///< where formula or value come from
    bool logarithmic = false;         ///< slider scale
};

class ParamTable {
public:
    explicit ParamTable(std::vector<ParamRow> rows);
    const std::vector<ParamRow>& rows() const { return rows_; }
    /// Row of a key, or null.
    const ParamRow* find(std::string_view key) const;
    std::size_t index(std::string_view key) const; ///< key must exist

private:
    std::vector<ParamRow> rows_;
};

/// Values for the rows of a table, and which of them were set on purpose (the others follow the method's
/// defaults).
class ParamSet {
public:
    using Defaults = std::map<std::string, double>; ///< by key
    explicit ParamSet(const ParamTable& table);

    const ParamTable& table() const { return *table_; }
    double get(std::string_view key) const;
    int get_int(std::string_view key) const { return static_cast<int>(get(key)); }
    const std::string& get_choice(std::string_view key) const;
    bool edited(std::string_view key) const;

    /// Error (usage) naming the key when it is unknown, or the value is not a number or choice within the
    /// range.
    void set(std::string_view key, double value);
    void set_text(std::string_view key, std::string_view text);
    /// "KEY=VALUE". Error (usage) as above.
    void assign(std::string_view key_equals_value);
    /// Back to the default.
    void reset(std::string_view key);
    /// Replaces the default values (not the rows) of some keys; values not edited follow.
    void set_defaults(const Defaults& defaults);
    /// Defaults that go with one solver method (a scene brings them), kept until that is chosen again.
    void keep_defaults(const std::string& method, Defaults defaults);
    /// Those kept for a method; null without any.
    const Defaults* kept_defaults(const std::string& method) const;
    /// Those that another set keeps, in the place of this one's.
    void keep_defaults_of(const ParamSet& other) { kept_ = other.kept_; }
    double default_value(std::string_view key) const;

    std::string text(std::string_view key) const; ///< value as `set_text` reads it
    bool operator==(const ParamSet& other) const { return values_ == other.values_; }

private:
    void check(const ParamRow& row, double value, std::string_view shown) const;
    const ParamTable* table_;
    std::vector<double> values_;
    std::vector<double> defaults_;
    std::vector<bool> edited_;
    std::map<std::string, Defaults> kept_;
};

/// Shortest text that reads back as the same double; independent of the locale.
std::string number_text(double value);
/// Whole text as a double; false when it is not one. Independent of the locale; no NaN or infinity.
bool parse_number(std::string_view text, double& value);

} // namespace fascicle
