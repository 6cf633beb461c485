// Binary data of VTP: appended, compressed, both byte orders, both headers; and what is wrong with them.
#include "fascicle/base/error.hpp"
#include "io/base64.hpp"
#include "io/formats/vtp.hpp"

#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <cstring>
#include <zlib.h>

using namespace fascicle;
using Catch::Matchers::Contains;

namespace {

struct Form {
    bool big = false, wide = false, zlib = false;
    enum Place { inline_base64, appended_raw, appended_base64 } place = inline_base64;
    std::size_t block = 16; ///< bytes of a compressed block: many small ones
};

template <typename T>
std::string number(T value, bool big) {
    std::string raw(sizeof(T), '\0');
    std::memcpy(raw.data(), &value, sizeof(T));
    if (big != (std::endian::native == std::endian::big))
        std::reverse(raw.begin(), raw.end());
    return raw;
}

std::string header_number(std::uint64_t value, const Form& form) {
    return form.wide ? number<std::uint64_t>(value, form.big)
                     : number<std::uint32_t>(static_cast<std::uint32_t>(value), form.big);
}

std::string packed(std::string_view bytes) {
    uLongf size = compressBound(static_cast<uLong>(bytes.size()));
    std::string out(size, '\0');
    REQUIRE(compress(reinterpret_cast<Bytef*>(out.data()), &size,
                     reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uLong>(bytes.size())) == Z_OK);
    return out.substr(0, size);
}

/// As VTK writes an array: its header, then the data; base64 in one run, or in two when compressed.
std::string stored(const std::string& bytes, const Form& form, bool base64) {
    const auto text = [&](const std::string& b) { return base64 ? io::encode_base64(b) : b; };
    if (!form.zlib)
        return text(header_number(bytes.size(), form) + bytes);
    const std::size_t blocks = (bytes.size() + form.block - 1) / form.block;
    std::string head = header_number(blocks, form) + header_number(form.block, form) +
                       header_number(bytes.size() % form.block, form);
    std::string data;
    for (std::size_t b = 0; b < blocks; ++b) {
        const std::string block = packed(std::string_view(bytes).substr(b * form.block, form.block));
        head += header_number(block.size(), form);
        data += block;
    }
    return text(head) + text(data);
}

/// A file of four points, two triangles and an array of each number type.
class Maker {
public:
    explicit Maker(Form form) : form_(form) {}
    template <typename T>
    std::string array(const char* name, const char* type, int components,
                      std::initializer_list<double> values) {
        std::string bytes;
        for (const double v : values)
            bytes += number(static_cast<T>(v), form_.big);
        std::string out = std::string("<DataArray Name=\"") + name + "\" type=\"" + type +
                          "\" NumberOfComponents=\"" + std::to_string(components) + "\" format=\"";
        if (form_.place == Form::inline_base64)
            return out + "binary\">\n  " + stored(bytes, form_, true) + "\n</DataArray>";
        out += "appended\" offset=\"" + std::to_string(appended_.size()) + "\"/>";
        appended_ += stored(bytes, form_, form_.place == Form::appended_base64);
        return out;
    }
    std::string file(const std::string& inside) const {
        const bool base64 = form_.place == Form::appended_base64;
        return std::string(
                   "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"") +
               (form_.big ? "BigEndian" : "LittleEndian") + "\" header_type=\"" +
               (form_.wide ? "UInt64" : "UInt32") + "\"" +
               (form_.zlib ? " compressor=\"vtkZLibDataCompressor\"" : "") +
               ">\n<PolyData><Piece NumberOfPoints=\"4\" NumberOfPolys=\"2\">" + inside +
               "</Piece></PolyData>\n" +
               (form_.place == Form::inline_base64
                    ? std::string()
                    : std::string("<AppendedData encoding=\"") + (base64 ? "base64" : "raw") + "\">\n  _" +
                          appended_ + "\n</AppendedData>\n") +
               "</VTKFile>\n";
    }
    std::string sample() {
        std::string inside = "<PointData>";
        inside += array<std::int8_t>("Int8", "Int8", 1, {-128, 127, 0, 1});
        inside += array<std::uint8_t>("UInt8", "UInt8", 1, {0, 255, 60, 62}); // < and >, among others
        inside += array<std::int16_t>("Int16", "Int16", 1, {-32768, 1, 2, 3});
        inside += array<std::uint16_t>("UInt16", "UInt16", 1, {65535, 1, 2, 3});
        inside += array<std::int32_t>("Int32", "Int32", 1, {-2147483648.0, 1, 2, 3});
        inside += array<std::uint32_t>("UInt32", "UInt32", 1, {4294967295.0, 1, 2, 3});
        inside += array<std::int64_t>("Int64", "Int64", 1, {-9007199254740992.0, 1, 2, 3});
        inside += array<std::uint64_t>("UInt64", "UInt64", 1, {9007199254740992.0, 1, 2, 3});
        inside += array<float>("Float32", "Float32", 2, {0.5, -0.25, 1, 2, 3, 4, 5, 6});
        inside += array<double>("Float64", "Float64", 1, {0.1, -1e300, 2, 3});
        inside += "</PointData>";
        inside += "<Points>" +
                  array<double>("p", "Float64", 3, {0, 0, 0, 0.1, 0, 0, 1, 1.0 / 3, 0, 0, 1, 1e-9}) +
                  "</Points>";
        inside += "<Polys>" + array<std::int64_t>("connectivity", "Int64", 1, {0, 1, 2, 0, 2, 3}) +
                  array<std::int32_t>("offsets", "Int32", 1, {3, 6}) + "</Polys>";
        return file(inside);
    }

private:
    Form form_;
    std::string appended_;
};

MeshData read(const std::string& text) {
    return io::read_vtp(text, "a.vtp");
}

} // namespace

TEST_CASE("VTP: inline, appended raw and base64, zlib, both headers and byte orders, every number type",
          "[io][vtp]") {
    for (const bool big : {false, true})
        for (const bool wide : {false, true})
            for (const bool zlib : {false, true})
                for (const auto place : {Form::inline_base64, Form::appended_raw, Form::appended_base64})
                    for (const std::size_t block : {std::size_t{12}, std::size_t{16}, std::size_t{32768}}) {
                        INFO(big << wide << zlib << place << ' ' << block);
                        const MeshData data = read(Maker({big, wide, zlib, place, block}).sample());
                        CHECK(data.mesh.positions ==
                              Points{Vec3(0, 0, 0), Vec3(0.1, 0, 0), Vec3(1, 1.0 / 3, 0), Vec3(0, 1, 1e-9)});
                        CHECK(data.mesh.triangles == std::vector<Tri>{{0, 1, 2}, {0, 2, 3}});
                        REQUIRE(data.point_arrays.size() == 10);
                        const double first[] = {-128,
                                                0,
                                                -32768,
                                                65535,
                                                -2147483648.0,
                                                4294967295.0,
                                                -9007199254740992.0,
                                                9007199254740992.0,
                                                0.5,
                                                0.1};
                        for (std::size_t i = 0; i < 10; ++i)
                            CHECK(data.point_arrays[i].values[0] == first[i]);
                        CHECK(data.point_arrays[1].values == std::vector<double>{0, 255, 60, 62});
                        CHECK(data.point_arrays[8].values ==
                              std::vector<double>{0.5, -0.25, 1, 2, 3, 4, 5, 6});
                        CHECK(data.point_arrays[9].values == std::vector<double>{0.1, -1e300, 2, 3});
                    }
}

TEST_CASE("VTP: header and data in base64 runs of their own, as other writers do it", "[io][vtp]") {
    const Form form;
    const std::string bytes = number<double>(1, false) + number<double>(2, false) + number<double>(3, false) +
                              number<double>(0, false);
    const std::string split =
        io::encode_base64(header_number(bytes.size(), form)) + "\n" + io::encode_base64(bytes);
    std::string text = Maker(form).sample();
    const std::size_t at = text.find("<PointData>") + 11;
    text.insert(at, "<DataArray Name=\"split\" type=\"Float64\" format=\"binary\">" + split + "</DataArray>");
    CHECK(read(text).point_arrays[0].values == std::vector<double>{1, 2, 3, 0});
}

TEST_CASE("VTP: LZ4 and LZMA are refused with a sentence that says what to do", "[io][vtp]") {
    for (const auto& [compressor, name] : {std::pair("vtkLZ4DataCompressor", "LZ4"),
                                           {"vtkLZMADataCompressor", "LZMA"},
                                           {"vtkNewDataCompressor", "'vtkNewDataCompressor'"}}) {
        std::string text = Maker({false, false, true, Form::appended_raw}).sample();
        const std::string zlib = "vtkZLibDataCompressor";
        text.replace(text.find(zlib), zlib.size(), compressor);
        CHECK_THROWS_WITH(read(text), Contains(std::string("data compressed with ") + name) &&
                                          Contains("zlib or none") && Contains("a.vtp, line 3"));
    }
}

TEST_CASE("VTP: damaged and lying binary data", "[io][vtp]") {
    const auto fails = [](const std::string& text, const std::string& words) {
        CHECK_THROWS_WITH(read(text), Contains("a.vtp, line ") && Contains(words));
        CHECK_THROWS_AS(read(text), Error);
    };
    const auto changed = [](std::string text, const std::string& from, const std::string& to) {
        const std::size_t at = text.find(from);
        REQUIRE(at != std::string::npos);
        return text.replace(at, from.size(), to);
    };
    const std::string raw = Maker({false, false, false, Form::appended_raw}).sample();
    fails(changed(raw, "offset=\"0\"", "offset=\"99999\""), "offset is '99999'; expected at most");
    fails(changed(raw, "offset=\"0\"", "offset=\"-1\""), "offset is '-1'");
    fails(changed(raw, "\n  _", "\n  "), "without their mark");
    fails(changed(raw, "encoding=\"raw\"", "encoding=\"hex\""), "encoding 'hex'");
    fails(changed(raw, "</AppendedData", "</appended"), "expected </AppendedData>");
    fails(changed(raw, "AppendedData encoding", "Appended encoding"), "which has none");
    fails(changed(raw, "\n  _" + number<std::uint32_t>(4, false),
                  "\n  _" + number<std::uint32_t>(0x7fffffff, false)),
          "2147483647, as their header says");
    const MeshData wrong_type = read(changed(raw, "type=\"Int16\"", "type=\"Float64\""));
    CHECK(wrong_type.point_arrays.size() == 9);
    REQUIRE(wrong_type.notes.size() == 1);
    CHECK_THAT(wrong_type.notes[0], Contains("array 'Int16' is too short"));
}

namespace {

/// A compressed file whose first array tells these numbers in its header.
std::string bomb(std::uint64_t blocks, std::uint64_t block, std::uint64_t last, const std::string& data,
                 std::uint64_t size) {
    Form form{false, true, true, Form::appended_raw};
    std::string appended =
        header_number(blocks, form) + header_number(block, form) + header_number(last, form);
    for (std::uint64_t b = 0; b < std::min<std::uint64_t>(blocks, 64); ++b)
        appended += header_number(size, form);
    for (std::uint64_t b = 0; b < std::min<std::uint64_t>(blocks, 64); ++b)
        appended += data;
    return "<VTKFile type=\"PolyData\" header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\"><PolyData>"
           "<Piece NumberOfPoints=\"100000000\"><Points><DataArray type=\"Float64\" "
           "NumberOfComponents=\"3\" format=\"appended\" offset=\"0\"/></Points></Piece></PolyData>"
           "<AppendedData encoding=\"raw\">_" +
           appended + "</AppendedData></VTKFile>";
}

} // namespace

TEST_CASE("VTP: zip bombs are refused before anything is made of them", "[io][vtp]") {
    const auto fails = [](const std::string& text, const std::string& words) {
        CHECK_THROWS_WITH(read(text), Contains("a.vtp, line ") && Contains(words));
    };
    // 64 blocks of 32 MB of zeros, 32 kB each: 2 GB from 2 MB, more than the limit for a file of this size.
    const std::string zeros = packed(std::string(std::size_t{32} << 20, '\0'));
    fails(bomb(64, std::uint64_t{32} << 20, 0, zeros, zeros.size()), "more numbers than a file of this size");
    // Sizes that no zlib data can have, that overflow, that are nothing.
    fails(bomb(1, std::uint64_t{1} << 40, 0, "x", 1), "no more than zlib can pack");
    fails(bomb(64, ~std::uint64_t{0}, 0, "x", 1), "no more than zlib can pack");
    fails(bomb(~std::uint64_t{0}, 8, 0, "x", 1), "compressed blocks");
    fails(bomb(1, 0, 0, "x", 1), "compressed blocks of 0 bytes");
    fails(bomb(1, 8, 9, "x", 1), "no more than zlib can pack");
    fails(bomb(1, 8, 0, "x", ~std::uint64_t{0}), "bytes of a compressed block");
    // More, or less, than announced.
    const std::string hundred = packed(std::string(104, '\1'));
    fails(bomb(1, 96, 0, hundred, hundred.size()), "compressed block 0 is damaged");
    fails(bomb(1, 112, 0, hundred, hundred.size()), "compressed block 0 is damaged");
    fails(bomb(1, 104, 0, "nonsense", 8), "compressed block 0 is damaged");
    fails(bomb(1, 104, 0, hundred, hundred.size()), "13 coordinates; expected 3 times 100000000");
}

TEST_CASE("VTP: many arrays that name the same appended bytes do not multiply them", "[io][vtp]") {
    const std::string data(std::size_t{1} << 20, '\0');
    std::string arrays;
    for (int i = 0; i < 200; ++i)
        arrays +=
            "<DataArray Name=\"a" + std::to_string(i) + "\" type=\"Int8\" format=\"appended\" offset=\"0\"/>";
    const std::string text =
        "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"1048576\"><PointData>" + arrays +
        "</PointData></Piece></PolyData><AppendedData encoding=\"raw\">_" +
        number<std::uint32_t>(static_cast<std::uint32_t>(data.size()), false) + data +
        "</AppendedData></VTKFile>";
    CHECK_THROWS_WITH(read(text), Contains("more numbers than a file of this size is trusted with"));
}
