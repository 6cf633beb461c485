#include "fascicle/base/error.hpp"
#include "fascicle/io/csv.hpp"

#include <catch2/catch.hpp>
#include <limits>
#include <random>
#include <sstream>

using namespace fascicle;
using Catch::Matchers::Contains;

TEST_CASE("CSV: rows as spreadsheets want them", "[io][csv]") {
    std::ostringstream out;
    CsvWriter csv(out);
    csv.text("frame").text("a,b").text("say \"x\"").text("two\nlines").end_row();
    csv.integer(-3).number(0.1).number(1e300).number(std::numeric_limits<double>::quiet_NaN()).end_row();
    CHECK(out.str() == "frame,\"a,b\",\"say \"\"x\"\"\",\"two\nlines\"\n-3,0.1,1e+300,nan\n");
}

TEST_CASE("CSV: written and read again is the same", "[io][csv]") {
    std::mt19937 random(5);
    std::ostringstream out;
    CsvWriter csv(out);
    csv.text("name").text("x").end_row();
    std::vector<std::pair<std::string, double>> rows;
    for (int i = 0; i < 200; ++i) {
        std::string name = "n";
        for (unsigned k = random() % 8; k > 0; --k)
            name += "ab,\";\n x"[random() % 8];
        rows.emplace_back(name + "n",
                          std::ldexp(static_cast<double>(random()), static_cast<int>(random() % 600) - 300));
        csv.text(rows.back().first).number(rows.back().second).end_row();
    }
    const std::string bytes = out.str();
    CsvReader reader(bytes, "a.csv");
    for (const auto& [name, x] : rows) {
        REQUIRE(reader.next_row());
        REQUIRE(reader.cell(0) == name);
        REQUIRE(reader.number(1) == x);
    }
    CHECK_FALSE(reader.next_row());
}

TEST_CASE("CSV: separators, decimals, byte order mark, line ends, blank rows", "[io][csv]") {
    const auto check = [](const std::string& bytes) {
        CsvReader reader(bytes, "a.csv");
        REQUIRE(reader.columns() == std::vector<std::string>{"name", "x", "y"});
        REQUIRE(reader.next_row());
        CHECK(reader.cell(0) == "a");
        CHECK(reader.number(1) == 1.5);
        CHECK(reader.number(reader.column("y")) == -2000.0);
        REQUIRE(reader.next_row());
        CHECK(reader.cell(0) == "b");
        CHECK_FALSE(reader.next_row());
    };
    check("name,x,y\na,1.5,-2e3\nb,1,2\n");
    check("\xef\xbb\xbfName;X;Y\r\n\r\na;1,5;-2000\r\n;;\r\nb;1;2");
    check("name\tx\ty\r a \t 1,5 \t-2000.0\r\rb\t1\t2\r");
    check("\n\n name , x , y \na,\"1,5\",-2000,\nb,1,2,,\n");
}

TEST_CASE("CSV: mistakes name the line", "[io][csv]") {
    const auto reads = [](const std::string& bytes) {
        CsvReader reader(bytes, "a.csv");
        while (reader.next_row())
            for (int k = 0; k < 2; ++k)
                reader.number(k);
    };
    CHECK_THROWS_WITH(reads(""), Contains("a.csv: the file is empty"));
    CHECK_THROWS_WITH(reads("\xef\xbb\xbf \n"), Contains("empty"));
    CHECK_THROWS_WITH(reads("x,y\n1,2\n\n3,z\n"),
                      Contains("a.csv, line 4: got 'z' in column 'y'; expected a number"));
    CHECK_THROWS_WITH(reads("x,y\n1\n"), Contains("line 2: got ''"));
    CHECK_THROWS_WITH(reads("x,y\n1,nan\n"), Contains("line 2"));
    CHECK_THROWS_WITH(reads("x,y\n1,2,3\n"), Contains("line 2: row of more than 2 cells"));
    CHECK_THROWS_WITH(reads("x,y\n1,\"2\n"), Contains("line 2: a quote is not closed"));
    CHECK_THROWS_WITH(reads("x,y\n1,\"2\"3\n"), Contains("line 2: text after a closing quote"));
    CHECK_THROWS_WITH(reads("x,y\n1,2,3;4\n"), Contains("line 2"));
    CHECK_THROWS_WITH(reads("x;y\n1;2,000,000\n"), Contains("line 2"));
}
