#include "fascicle/base/text.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;

TEST_CASE("names cannot break a line or steer a terminal", "[base][unit]") {
    CHECK(one_line("a\nb\x1b[31m\x7f") == "a b [31m ");
    CHECK(one_line("gr\xC3\xB6\xC3\x9F"
                   "e") == "gr\xC3\xB6\xC3\x9F"
                           "e");
}

TEST_CASE("bytes that are no UTF-8 are replaced, one by one", "[base][unit]") {
    const std::string bad = "\xEF\xBF\xBD";
    for (const char* good : {"", "plain", "\xC2\x80", "\xDF\xBF", "\xE0\xA0\x80", "\xED\x9F\xBF",
                             "\xEF\xBF\xBF", "\xF0\x90\x80\x80", "\xF4\x8F\xBF\xBF"})
        CHECK(valid_utf8(good) == good);
    CHECK(valid_utf8("a\xFF"
                     "b") == "a" + bad + "b");
    CHECK(valid_utf8("\xC0\xAF") == bad + bad);                     // overlong '/'
    CHECK(valid_utf8("\xE0\x80\xAF") == bad + bad + bad);           // overlong
    CHECK(valid_utf8("\xED\xA0\x80") == bad + bad + bad);           // half of a pair
    CHECK(valid_utf8("\xF4\x90\x80\x80") == bad + bad + bad + bad); // beyond the last one
    CHECK(valid_utf8("x\xE2\x82") == "x" + bad + bad);              // cut off
}

TEST_CASE("a name calls a file that stays in its folder", "[base][unit]") {
    CHECK(file_name_for("psoas major") == "psoas major");
    CHECK(file_name_for("../../etc/passwd") == "_.._.._etc_passwd");
    CHECK(file_name_for("..") == "_..");
    CHECK(file_name_for("") == "_");
    CHECK(file_name_for("a\\b\nc") == "a_b_c");
    CHECK(file_name_for(std::string("a\0b", 3)) == "a_b");
    const std::string x = file_name_for(std::string(5000, 'x')), y = file_name_for(std::string(5001, 'x'));
    CHECK(x.size() == 150);
    CHECK(x != y);
    std::string wide;
    while (wide.size() < 1000)
        wide += "\xE9\xAA\xA8";
    CHECK(valid_utf8(file_name_for(wide)) == file_name_for(wide));
}
