#include "fascicle/base/content_hash.hpp"

#include <bit>
#include <cstdio>
#include <cstring>

namespace fascicle {

namespace {

// Odd constants with well spread bits: digits of the golden ratio and of the square roots of 2 and 3.
constexpr std::uint64_t odd_1 = 0x9e3779b97f4a7c15u, odd_2 = 0x6a09e667f3bcc909u, odd_3 = 0xbb67ae8584caa73bu;

std::uint64_t step(std::uint64_t lane, std::uint64_t word) {
    return std::rotl((lane ^ (word * odd_1)) * odd_2, 29) + odd_3;
}

std::uint64_t mixed(std::uint64_t x) {
    x = (x ^ (x >> 32)) * odd_1;
    x = (x ^ (x >> 29)) * odd_3;
    return x ^ (x >> 32);
}

} // namespace

void ContentHash::add_bytes(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    std::array<std::uint64_t, 4> words{};
    std::array<std::uint64_t, 4> lanes = lanes_;
    std::size_t at = 0;
    for (; at + sizeof words <= size; at += sizeof words) {
        std::memcpy(words.data(), bytes + at, sizeof words);
        for (std::size_t i = 0; i < 4; ++i)
            lanes[i] = step(lanes[i], words[i]);
    }
    words = {};
    if (at < size)
        std::memcpy(words.data(), bytes + at, size - at);
    for (std::size_t i = 0; i < 4; ++i)
        lanes[i] = step(step(lanes[i], words[i]), size + i);
    lanes_ = lanes;
}

std::array<std::uint64_t, 2> ContentHash::value() const {
    std::array<std::uint64_t, 2> result{odd_2, odd_3};
    for (const std::uint64_t lane : lanes_) {
        result[0] = mixed(result[0] ^ lane);
        result[1] = mixed(result[1] + std::rotl(lane, 17) * odd_2);
    }
    return result;
}

std::string ContentHash::hex() const {
    const auto [high, low] = value();
    char text[33];
    std::snprintf(text, sizeof text, "%016llx%016llx", static_cast<unsigned long long>(high),
                  static_cast<unsigned long long>(low));
    return text;
}

} // namespace fascicle
