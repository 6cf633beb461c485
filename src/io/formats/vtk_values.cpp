#include "io/formats/vtk_values.hpp"

#include "fascicle/base/assert.hpp"

#include <bit>
#include <cstdint>
#include <utility>

namespace fascicle::io {

std::optional<VtkType> vtk_type(std::string_view name) {
    using K = VtkKind;
    // Sizes as VTK writes them: long has 8 bytes on the systems that write such files today, vtkIdType is
    // written as a 4-byte int.
    static constexpr std::pair<std::string_view, VtkType> types[] = {
        {"float", {K::floating, 4}},
        {"double", {K::floating, 8}},
        {"int", {K::integer, 4}},
        {"unsigned_int", {K::unsigned_integer, 4}},
        {"long", {K::integer, 8}},
        {"unsigned_long", {K::unsigned_integer, 8}},
        {"short", {K::integer, 2}},
        {"unsigned_short", {K::unsigned_integer, 2}},
        {"char", {K::integer, 1}},
        {"signed_char", {K::integer, 1}},
        {"unsigned_char", {K::unsigned_integer, 1}},
        {"long_long", {K::integer, 8}},
        {"unsigned_long_long", {K::unsigned_integer, 8}},
        {"__int64", {K::integer, 8}},
        {"unsigned___int64", {K::unsigned_integer, 8}},
        {"vtkidtype", {K::integer, 4}},
        {"vtktypeint64", {K::integer, 8}},
        {"vtktypeuint64", {K::unsigned_integer, 8}},
        {"vtktypeint32", {K::integer, 4}},
        {"vtktypeuint32", {K::unsigned_integer, 4}},
        {"bit", {K::bit, 0}},
        {"string", {K::text, 0}},
        {"utf8_string", {K::text, 0}},
    };
    const std::string wanted = lower_case(name);
    for (const auto& [known, type] : types)
        if (known == wanted)
            return type;
    return std::nullopt;
}

void VtkValues::end_header() {
    if (!binary_)
        return;
    const std::size_t start = scanner_.position();
    const std::string_view rest = scanner_.bytes().substr(start);
    const std::size_t end = rest.find('\n');
    if (end == std::string_view::npos || !trimmed(rest.substr(0, end)).empty())
        scanner_.fail_at(start, "no line end before binary data",
                         "a line feed after the last word of the line");
    scanner_.move_to(start + end + 1);
}

void VtkValues::require(const VtkType& type, std::size_t count, const char* what) {
    std::size_t available = 0;
    if (!binary_)
        available = (scanner_.remaining() + 1) / 2;
    else if (type.kind == VtkKind::bit)
        available = scanner_.remaining() * 8;
    else
        available = scanner_.remaining() / (type.size == 0 ? 1 : type.size);
    if (count > available)
        scanner_.fail_at(scanner_.position(), "the file ends too early",
                         std::to_string(count) + " numbers for " + what + ", which do not fit what is left");
}

unsigned long long VtkValues::next_bytes(std::size_t size) {
    last_ = scanner_.position();
    FASCICLE_ASSERT(size <= scanner_.remaining());
    unsigned long long bits = 0;
    for (std::size_t i = 0; i < size; ++i)
        bits = (bits << 8) | static_cast<unsigned char>(scanner_.bytes()[last_ + i]);
    scanner_.move_to(last_ + size);
    return bits;
}

double VtkValues::next_double(const VtkType& type, const char* what) {
    if (!binary_) {
        scanner_.skip_space();
        last_ = scanner_.position();
        return scanner_.next_double(what);
    }
    if (type.kind != VtkKind::floating) {
        const long long value = next_integer(type, what);
        return type.kind == VtkKind::unsigned_integer
                   ? static_cast<double>(static_cast<unsigned long long>(value))
                   : static_cast<double>(value);
    }
    const unsigned long long bits = next_bytes(type.size);
    return type.size == 4 ? static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)))
                          : std::bit_cast<double>(static_cast<std::uint64_t>(bits));
}

long long VtkValues::next_integer(const VtkType& type, const char* what) {
    if (!binary_) {
        scanner_.skip_space();
        last_ = scanner_.position();
        return scanner_.next_integer(what);
    }
    const unsigned long long bits = next_bytes(type.size);
    if (type.kind == VtkKind::integer && type.size < 8) { // sign from the type's own highest bit
        const unsigned long long sign = 1ull << (8 * type.size - 1);
        return static_cast<long long>((bits ^ sign) - sign);
    }
    return static_cast<long long>(bits);
}

void VtkValues::skip(const VtkType& type, std::size_t count, const char* what) {
    require(type, count, what);
    if (binary_ && type.kind == VtkKind::text) {
        skip_binary_texts(count, what);
    } else if (binary_) {
        scanner_.move_to(scanner_.position() +
                         (type.kind == VtkKind::bit ? (count + 7) / 8 : count * type.size));
    } else if (type.kind == VtkKind::text) { // one encoded text a line, possibly empty
        for (std::size_t i = 0; i < count; ++i)
            scanner_.next_line();
    } else {
        for (std::size_t i = 0; i < count; ++i)
            scanner_.next_double(what);
    }
}

void VtkValues::skip_binary_texts(std::size_t count, const char* what) {
    // Length first: the two highest bits of the first byte tell whether it takes 8, 4, 2 or 1 bytes.
    for (std::size_t i = 0; i < count; ++i) {
        require({VtkKind::unsigned_integer, 1}, 1, what);
        const std::size_t header =
            std::size_t{8} >> (static_cast<unsigned char>(scanner_.bytes()[scanner_.position()]) >> 6);
        require({VtkKind::unsigned_integer, 1}, header, what);
        const unsigned long long length = next_bytes(header) & (~0ull >> (64 - 8 * header + 2));
        if (length > scanner_.remaining())
            scanner_.fail_at(last_, "the file ends too early",
                             "a text of " + std::to_string(length) + " bytes");
        scanner_.move_to(scanner_.position() + static_cast<std::size_t>(length));
    }
}

} // namespace fascicle::io
