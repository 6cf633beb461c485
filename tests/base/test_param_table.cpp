#include "fascicle/base/error.hpp"
#include "fascicle/base/param_table.hpp"

#include <catch2/catch.hpp>
#include <clocale>

using namespace fascicle;

namespace {

const ParamTable& table() {
    static const ParamTable rows({
        {"a.real", "Real", "mm", ParamKind::real, 0, 2, 0.5, {}, "", "", false},
        {"a.count", "Count", "1", ParamKind::integer, 1, 10, 3, {}, "", "", false},
        {"a.kind", "Kind", "1", ParamKind::choice, 0, 1, 0, {"soft", "stiff"}, "", "", false},
    });
    return rows;
}

std::string message_of(const std::string& assignment) {
    ParamSet set(table());
    try {
        set.assign(assignment);
    } catch (const Error& error) {
        CHECK(error.kind() == ErrorKind::usage);
        return error.what();
    }
    return "";
}

} // namespace

TEST_CASE("parameters: values, choices and text", "[base][param_table]") {
    ParamSet set(table());
    set.assign("a.real=1.25");
    set.assign("a.count=7");
    set.assign("a.kind=stiff");
    CHECK(set.get("a.real") == 1.25);
    CHECK(set.get_int("a.count") == 7);
    CHECK(set.get_choice("a.kind") == "stiff");
    CHECK(set.text("a.kind") == "stiff");
    CHECK(set.text("a.real") == "1.25");
    CHECK(set.edited("a.real"));
    set.reset("a.real");
    CHECK(set.get("a.real") == 0.5);
    CHECK_FALSE(set.edited("a.real"));
}

TEST_CASE("parameters: a wrong assignment is one line that names key, value and range",
          "[base][param_table]") {
    CHECK(message_of("a.real=3").find("a.real") != std::string::npos);
    CHECK(message_of("a.real=3").find("from 0 to 2 mm") != std::string::npos);
    CHECK(message_of("a.count=2.5").find("whole number") != std::string::npos);
    CHECK(message_of("a.kind=hard").find("soft, stiff") != std::string::npos);
    CHECK(message_of("a.other=1").find("no such parameter") != std::string::npos);
    for (const char* bad :
         {"a.real=nan", "a.real=inf", "a.real=", "a.real=1,5", "a.real=1x", "a.real", "", "=", "a.real=1 2"})
        CHECK_FALSE(message_of(bad).empty());
    CHECK(message_of("a.re\nal=1").find('\n') == std::string::npos);
}

TEST_CASE("parameters: a method's defaults move only what was not set", "[base][param_table]") {
    ParamSet set(table());
    set.set("a.real", 1.5);
    set.set_defaults({{"a.real", 0.1}, {"a.count", 9}});
    CHECK(set.get("a.real") == 1.5);
    CHECK(set.get("a.count") == 9);
    set.reset("a.real");
    CHECK(set.get("a.real") == 0.1);
    set.set_defaults({});
    CHECK(set.get("a.count") == 3);
}

TEST_CASE("numbers read and write alike, whatever the locale", "[base][param_table]") {
    for (const double value : {0.0, 0.1, 1.0 / 3.0, -2.5e-300, 1e22, 123456.789}) {
        double back = -1;
        CHECK(parse_number(number_text(value), back));
        CHECK(back == value);
    }
    double value = 0;
    CHECK(parse_number("+4", value));
    CHECK_FALSE(parse_number("0,5", value));
    CHECK_FALSE(parse_number("1e999", value));
}
