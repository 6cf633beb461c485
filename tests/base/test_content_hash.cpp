#include "fascicle/base/content_hash.hpp"

#include <catch2/catch.hpp>
#include <set>

using namespace fascicle;

namespace {

std::string hash_of(const std::string& bytes) {
    ContentHash hash;
    hash.add_bytes(bytes.data(), bytes.size());
    return hash.hex();
}

} // namespace

TEST_CASE("content hashes tell every changed bit, length and order", "[base][content_hash]") {
    std::set<std::string> seen;
    std::string bytes(100, 'x');
    seen.insert(hash_of(bytes));
    for (std::size_t i = 0; i < bytes.size(); ++i)
        for (int bit = 0; bit < 8; ++bit) {
            std::string changed = bytes;
            changed[i] = static_cast<char>(changed[i] ^ (1 << bit));
            seen.insert(hash_of(changed));
        }
    CHECK(seen.size() == 801);
    for (std::size_t length = 0; length < 100; ++length)
        seen.insert(hash_of(std::string(length, '\0'))); // zeros at the end count
    CHECK(seen.size() == 901);
    CHECK(hash_of(bytes) == hash_of(std::string(100, 'x')));
    CHECK(hash_of("abc").size() == 32);
    ContentHash one, two;
    one.add_number(1.0);
    one.add_number(2.0);
    two.add_number(2.0);
    two.add_number(1.0);
    CHECK(one.hex() != two.hex());
}

TEST_CASE("both halves of a content hash are well spread", "[base][content_hash]") {
    // 64 buckets of 64 each expected; sums of squared deviations far from that mean a bad mix.
    for (const std::size_t half : {0u, 1u})
        for (const int shift : {0, 29, 58}) {
            std::array<int, 64> buckets{};
            for (std::uint64_t i = 0; i < 4096; ++i) {
                ContentHash hash;
                hash.add_number(i);
                ++buckets[(hash.value()[half] >> shift) & 63u];
            }
            double chi2 = 0;
            for (const int n : buckets)
                chi2 += (n - 64.0) * (n - 64.0) / 64.0;
            CHECK(chi2 < 130.0); // 63 degrees of freedom: beyond 5 standard deviations
            CHECK(chi2 > 20.0);
        }
}
