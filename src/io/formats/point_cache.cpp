#include "io/formats/point_cache.hpp"

#include "fascicle/base/error.hpp"
#include "io/formats/text_scanner.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace fascicle::io {

namespace {

constexpr std::string_view pc2_mark("POINTCACHE2\0", 12);

void put_word(std::string& out, std::uint32_t word, bool big_endian) {
    for (int i = 0; i < 4; ++i)
        out += static_cast<char>(word >> (8 * (big_endian ? 3 - i : i)) & 0xFF);
}

/// Error naming `where` and `what` when no float holds the value.
void put_float(std::string& out, double value, bool big_endian, const char* what, const std::string& where) {
    constexpr double most = std::numeric_limits<float>::max();
    if (!(std::abs(value) <= most))
        throw_error(where,
                    std::string(what) + " is beyond " + std::to_string(std::numeric_limits<float>::max()),
                    "numbers that a float can hold");
    put_word(out, std::bit_cast<std::uint32_t>(static_cast<float>(value)), big_endian);
}

std::uint32_t word_at(std::string_view bytes, std::size_t at, bool big_endian) {
    std::uint32_t word = 0;
    for (std::size_t i = 0; i < 4; ++i)
        word |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + i]))
                << (8 * (big_endian ? 3 - i : i));
    return word;
}

double float_at(std::string_view bytes, std::size_t at, bool big_endian) {
    return std::bit_cast<float>(word_at(bytes, at, big_endian));
}

[[noreturn]] void fail(const std::string& file, std::size_t at, const std::string& what,
                       const std::string& expected) {
    throw_error(file + ", byte " + std::to_string(at), what, expected);
}

void write_samples(std::ostream& out, const AnimatedBody& body, const Animation& animation, bool big_endian,
                   const JobControl& control, const std::string& where) {
    Points points;
    std::string bytes;
    for (std::size_t k = 0; k < animation.frame_count(); ++k) {
        control.checkpoint("writing", static_cast<double>(k) / static_cast<double>(animation.frame_count()));
        points_in_frame(body, k, points);
        bytes.clear();
        for (const Vec3& p : points)
            for (int c = 0; c < 3; ++c)
                put_float(bytes, p[c], big_endian, "a coordinate", where);
        out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    }
}

/// A count at a byte, and whether the file can hold that many values.
std::size_t count_at(std::string_view bytes, std::size_t at, bool big_endian, const std::string& file,
                     const char* what) {
    const std::uint32_t count = word_at(bytes, at, big_endian);
    if (count == 0 || count > max_elements)
        fail(file, at, std::to_string(static_cast<std::int32_t>(count)) + " " + what, "1 or more");
    return count;
}

void take_values(PointCache& cache, std::string_view bytes, std::size_t start, const std::string& file) {
    const std::uint64_t needed = std::uint64_t{cache.samples} * cache.points * 12;
    if (start > bytes.size() || needed > bytes.size() - start)
        fail(file, bytes.size(), "the file ends", std::to_string(needed) + " bytes of coordinates");
    cache.values = bytes.substr(start, static_cast<std::size_t>(needed));
}

} // namespace

void write_pc2(std::ostream& out, const AnimatedBody& body, const Animation& animation,
               const JobControl& control, const std::string& where) {
    std::string head(pc2_mark);
    put_word(head, 1, false);
    put_word(head, static_cast<std::uint32_t>(body.rest.size()), false);
    put_float(head, animation.frames.front(), false, "a frame", where);
    put_float(head, animation.frame_count() > 1 ? animation.frames[1] - animation.frames[0] : 1, false,
              "a frame", where);
    put_word(head, static_cast<std::uint32_t>(animation.frame_count()), false);
    out.write(head.data(), static_cast<std::streamsize>(head.size()));
    write_samples(out, body, animation, false, control, where);
}

void write_mdd(std::ostream& out, const AnimatedBody& body, const Animation& animation,
               const JobControl& control, const std::string& where) {
    std::string head;
    put_word(head, static_cast<std::uint32_t>(animation.frame_count()), true);
    put_word(head, static_cast<std::uint32_t>(body.rest.size()), true);
    for (std::size_t k = 0; k < animation.seconds.size(); ++k) {
        put_float(head, animation.seconds[k], true, "a time", where);
        if (k > 0 && !(float_at(head, head.size() - 4, true) > float_at(head, head.size() - 8, true)))
            throw_error(where,
                        "frame " + std::to_string(animation.frames[k]) +
                            " is at the time of the one before it, in floats",
                        "times that floats can tell apart");
    }
    out.write(head.data(), static_cast<std::streamsize>(head.size()));
    write_samples(out, body, animation, true, control, where);
}

void PointCache::read(std::size_t k, Points& out, const std::string& file) const {
    out.resize(points);
    const std::size_t start = k * points * 12;
    for (std::size_t i = 0; i < points; ++i)
        for (int c = 0; c < 3; ++c) {
            out[i][c] = float_at(values, start + i * 12 + static_cast<std::size_t>(c) * 4, big_endian);
            if (!std::isfinite(out[i][c]))
                throw_error(
                    file, "point " + std::to_string(i) + " of sample " + std::to_string(k) + " is not finite",
                    "finite coordinates");
        }
}

PointCache read_pc2(std::string_view bytes, const std::string& file) {
    if (bytes.substr(0, 12) != pc2_mark)
        fail(file, 0, "not a PC2 file", "POINTCACHE2");
    if (bytes.size() < 32)
        fail(file, bytes.size(), "the file ends", "a header of 32 bytes");
    if (word_at(bytes, 12, false) != 1)
        fail(file, 12, "version " + std::to_string(word_at(bytes, 12, false)), "1");
    PointCache cache;
    cache.points = count_at(bytes, 16, false, file, "points");
    cache.first_frame = float_at(bytes, 20, false);
    cache.frame_step = float_at(bytes, 24, false);
    cache.samples = count_at(bytes, 28, false, file, "samples");
    if (!(std::abs(cache.first_frame) < 1e9) || !(cache.frame_step > 0 && cache.frame_step < 1e6))
        fail(file, 20, "a bad first frame or distance of frames", "finite numbers, the distance over 0");
    take_values(cache, bytes, 32, file);
    return cache;
}

PointCache read_mdd(std::string_view bytes, const std::string& file) {
    if (bytes.size() < 8)
        fail(file, bytes.size(), "the file ends", "a header of 8 bytes");
    PointCache cache;
    cache.big_endian = true;
    cache.samples = count_at(bytes, 0, true, file, "samples");
    cache.points = count_at(bytes, 4, true, file, "points");
    if (cache.samples > (bytes.size() - 8) / 4)
        fail(file, bytes.size(), "the file ends", std::to_string(cache.samples) + " times");
    take_values(cache, bytes, 8 + 4 * cache.samples, file);
    for (std::size_t k = 0; k < cache.samples; ++k) {
        cache.seconds.push_back(float_at(bytes, 8 + 4 * k, true));
        if (!std::isfinite(cache.seconds[k]) || (k > 0 && !(cache.seconds[k] > cache.seconds[k - 1])))
            fail(file, 8 + 4 * k, "times that do not rise", "ascending times");
    }
    return cache;
}

} // namespace fascicle::io
