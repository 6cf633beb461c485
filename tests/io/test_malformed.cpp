// Damaged files of every format: each must end in a mesh or in an Error, quickly.
#include "fascicle/base/error.hpp"
#include "fascicle/io/mesh_file.hpp"
#include "io/mesh_samples.hpp"

#include <catch2/catch.hpp>
#include <random>

using namespace fascicle;
using namespace fascicle::test;

namespace {

/// A mesh whose indices are in range and whose coordinates are finite, or an Error of one line. True for a
/// mesh.
bool survives(const std::string& bytes, const std::string& name) {
    try {
        const MeshFile file = read_mesh_bytes(bytes, name);
        const MeshReport again = check_mesh(file.mesh);
        REQUIRE(again.usable());
        for (const auto& line : file.lines.lines)
            for (const int v : line)
                REQUIRE((v >= 0 && static_cast<std::size_t>(v) < file.lines.points.size()));
        return true;
    } catch (const Error& error) {
        const std::string message = error.what();
        REQUIRE(message.find('\n') == std::string::npos);
        REQUIRE(message.find(name) != std::string::npos);
        return false;
    }
}

} // namespace

TEST_CASE("the samples themselves are good", "[io][malformed]") {
    for (const auto& [name, bytes] : mesh_samples()) {
        INFO(name);
        CHECK(survives(bytes, name));
    }
}

TEST_CASE("files cut off at any byte", "[io][malformed]") {
    for (const auto& [name, bytes] : mesh_samples()) {
        INFO(name);
        for (std::size_t n = 0; n < bytes.size(); ++n)
            survives(bytes.substr(0, n), name);
    }
}

TEST_CASE("files with flipped, lost, doubled and foreign bytes", "[io][malformed]") {
    std::mt19937 random(20240607);
    const std::string foreign[] = {"nan",
                                   "-1",
                                   "1e400",
                                   "99999999999999999999",
                                   "4294967296",
                                   "2147483647",
                                   "-2147483648",
                                   "\n",
                                   "\r",
                                   "\t",
                                   "POINTS 999999999 float\n",
                                   "f 1 2 3 4 5 6 7 8\n",
                                   "<",
                                   ">",
                                   "\"",
                                   "\\\n",
                                   "9223372036854775807",
                                   "1e38",
                                   "property list uchar int y\n",
                                   "element vertex 2147483648\n",
                                   "<![CDATA[",
                                   "BINARY",
                                   "#",
                                   "0",
                                   std::string(1, '\0'),
                                   "\xff\xff\xff\xff"};
    for (const auto& [name, bytes] : mesh_samples()) {
        INFO(name);
        int good = 0, bad = 0;
        for (int round = 0; round < 2500; ++round) {
            std::string damaged = bytes;
            const int changes = 1 + static_cast<int>(random() % 4);
            for (int i = 0; i < changes && !damaged.empty(); ++i) {
                const std::size_t at = random() % damaged.size();
                switch (random() % 5) {
                case 0:
                    damaged[at] = static_cast<char>(random());
                    break;
                case 1:
                    damaged[at] = static_cast<char>(damaged[at] ^ (1 << (random() % 8)));
                    break;
                case 2:
                    damaged.erase(at, 1 + random() % 8);
                    break;
                case 3:
                    damaged.insert(at, damaged.substr(random() % damaged.size(), random() % 40));
                    break;
                default:
                    damaged.replace(at, random() % 6, foreign[random() % std::size(foreign)]);
                }
            }
            ++(survives(damaged, name) ? good : bad);
        }
        CHECK(good > 0); // the damage is not so heavy that everything ends in the first line
        CHECK(bad > 0);
    }
}
