#pragma once
// Runs of numbers in legacy VTK files: one interface for words (ASCII) and big-endian bytes (BINARY).

#include "io/formats/text_scanner.hpp"

#include <optional>

namespace fascicle::io {

enum class VtkKind { floating, integer, unsigned_integer, bit, text };

struct VtkType {
    VtkKind kind = VtkKind::floating;
    std::size_t size = 4; ///< bytes in a binary file; 0 for bit and text
};

/// Type of a name such as "float" or "vtktypeint64", in any case; none when it is unknown.
std::optional<VtkType> vtk_type(std::string_view name);

class VtkValues {
public:
    explicit VtkValues(TextScanner& scanner) : scanner_(scanner) {}

    /// Numbers are ASCII until this is called.
    void set_binary() { binary_ = true; }
    bool binary() const { return binary_; }
    /// Call after the last word of a header line: binary data start after the line's end.
    void end_header();
    /// Error unless the file still holds `count` numbers of the type; call before allocating. ASCII numbers
    /// take at least a digit and a space.
    void require(const VtkType& type, std::size_t count, const char* what);
    /// Next number. require() must have been called for BINARY. Error when it is not of the type (ASCII).
    double next_double(const VtkType& type, const char* what);
    long long next_integer(const VtkType& type, const char* what);
    void skip(const VtkType& type, std::size_t count, const char* what);
    /// Place of the number read last.
    std::size_t last_position() const { return last_; }

private:
    unsigned long long next_bytes(std::size_t size);
    void skip_binary_texts(std::size_t count, const char* what);

    TextScanner& scanner_;
    bool binary_ = false;
    std::size_t last_ = 0;
};

} // namespace fascicle::io
