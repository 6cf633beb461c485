#include "io/mesh_samples.hpp"

#include "fascicle/io/mesh_convert.hpp"
#include "support/shapes.hpp"

#include <sstream>
#include <zlib.h>

namespace fascicle::test {
namespace {

std::string little_endian(std::uint64_t value, int bytes) {
    std::string out;
    for (int i = 0; i < bytes; ++i)
        out += static_cast<char>((value >> (8 * i)) & 0xff);
    return out;
}

std::string legacy_ascii() {
    return "# vtk DataFile Version 5.1\nt\nASCII\nDATASET POLYDATA\nPOINTS 4 float\n0 0 0 1 0 0 1 1 0 0 1 0\n"
           "METADATA\nINFORMATION 1\nNAME a LOCATION b\nDATA 1\n\nPOLYGONS 3 7\nOFFSETS vtktypeint64\n0 4 7\n"
           "CONNECTIVITY vtktypeint64\n0 1 2 3 0 1 2\nTRIANGLE_STRIPS 1 5\n4 0 1 3 2\nCELL_DATA 3\n"
           "SCALARS s float 1\nLOOKUP_TABLE default\n1 2 3\nFIELD f 1\nx 2 3 int\n1 2 3 4 5 6\nPOINT_DATA 4\n"
           "VECTORS v double\n1 2 3 1 2 3 1 2 3 1 2 3\nCOLOR_SCALARS c 2\n0 0 0 1 1 1 0 0\n";
}

std::string legacy_binary() {
    std::string out = "# vtk DataFile Version 3.0\nt\nBINARY\nDATASET POLYDATA\nPOINTS 3 float\n";
    out += std::string(36, '\0') + "\nPOLYGONS 1 4\n";
    out += std::string("\0\0\0\3\0\0\0\0\0\0\0\1\0\0\0\2", 16) + "\nCELL_DATA 1\nFIELD f 2\na 1 1 string\n";
    out += std::string("\xc2hi", 3) +
           "\nb 1 1 double\n12345678\nPOINT_DATA 3\nSCALARS s bit\nLOOKUP_TABLE d\nx\n";
    return out;
}

std::string vtp_inline() {
    return "<?xml version=\"1.0\"?><VTKFile type=\"PolyData\" byte_order=\"LittleEndian\"><PolyData><Piece "
           "NumberOfPoints=\"3\" NumberOfLines=\"1\" NumberOfPolys=\"1\"><PointData><DataArray Name=\"d\" "
           "type=\"Float32\" "
           "format=\"binary\">DAAAAAAAgD8AAIA/AACAPw==</DataArray></PointData><Points><DataArray "
           "type=\"Float32\" NumberOfComponents=\"3\" format=\"binary\">"
           "JAAAAAAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAA==</DataArray></Points><Lines><DataArray "
           "Name=\"connectivity\" type=\"Int64\">0 1 2</DataArray><DataArray type=\"Int8\" "
           "Name=\"offsets\">3</DataArray></Lines><Polys><DataArray type=\"Int32\" Name=\"connectivity\">0 1 "
           "2</DataArray><DataArray type=\"Int32\" "
           "Name=\"offsets\">3</DataArray></Polys></Piece></PolyData></VTKFile>";
}

/// Appended raw, zlib, UInt64 headers, as ParaView saves by default.
std::string vtp_appended() {
    std::string data;
    const auto array = [&](const char* attributes, const std::string& bytes) {
        const std::string out = std::string("<DataArray ") + attributes + " format=\"appended\" offset=\"" +
                                std::to_string(data.size()) + "\"/>";
        uLongf size = compressBound(static_cast<uLong>(bytes.size()));
        std::string packed(size, '\0');
        compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                 static_cast<uLong>(bytes.size()));
        data += little_endian(1, 8) + little_endian(32768, 8) + little_endian(bytes.size(), 8) +
                little_endian(size, 8) + packed.substr(0, size);
        return out;
    };
    std::string points(72, '\0'), connectivity, xml;
    points[24 + 6] = points[48 + 8 + 6] = '\xf0'; // 1.0
    points[24 + 7] = points[48 + 8 + 7] = '\x3f';
    for (const std::uint64_t v : {0u, 1u, 2u})
        connectivity += little_endian(v, 8);
    xml = "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\" "
          "compressor=\"vtkZLibDataCompressor\"><PolyData><Piece NumberOfPoints=\"3\" "
          "NumberOfPolys=\"1\"><Points>";
    xml += array("type=\"Float64\" NumberOfComponents=\"3\"", points) + "</Points><Polys>";
    xml += array("type=\"Int64\" Name=\"connectivity\"", connectivity);
    xml += array("type=\"Int64\" Name=\"offsets\"", little_endian(3, 8));
    return xml + "</Polys></Piece></PolyData><AppendedData encoding=\"raw\">_" + data +
           "</AppendedData></VTKFile>";
}

std::string ply_ascii() {
    return "ply\nformat ascii 1.0\ncomment c\nelement vertex 4\nproperty float x\nproperty float y\nproperty "
           "float z\nproperty list uchar int l\nproperty uchar red\nproperty uchar green\nproperty uchar "
           "blue\n"
           "element face 2\nproperty list uchar int vertex_indices\nproperty float q\nelement edge "
           "1\nproperty "
           "int vertex1\nproperty int vertex2\nend_header\n0 0 0 1 5 1 2 3\n1 0 0 0 1 2 3\n1 1 0 2 6 7 1 2 "
           "3\n"
           "0 1 0 0 1 2 3\n4 0 1 2 3 0.5\n3 0 2 1 0.5\n0 2\n";
}

std::string ply_big_endian() {
    std::string out =
        "ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty short x\nproperty short y\n"
        "property short z\nproperty uchar t_0\nproperty uchar t_1\nelement tristrips 1\nproperty "
        "list int short vertex_indices\nend_header\n";
    for (int v = 0; v < 3; ++v)
        out += std::string("\0\0\0\0\0\0\1\2", 8).replace(static_cast<std::size_t>(2 * v) + 1, 1, 1, '\1');
    return out + std::string("\0\0\0\3\0\0\0\1\0\2", 10);
}

} // namespace

TriMesh as_stl_has_it(const TriMesh& mesh) {
    TriMesh out;
    std::vector<int> number(mesh.positions.size(), -1);
    for (Tri t : mesh.triangles) {
        for (int& v : t) {
            int& n = number[static_cast<std::size_t>(v)];
            if (n < 0) {
                n = out.vertex_count();
                out.positions.push_back(
                    mesh.positions[static_cast<std::size_t>(v)].cast<float>().cast<double>());
            }
            v = n;
        }
        out.triangles.push_back(t);
    }
    return out;
}

std::string written(const MeshFormat& format, const MeshData& data) {
    std::ostringstream out;
    format.write(out, data);
    return out.str();
}

std::vector<std::pair<std::string, std::string>> mesh_samples() {
    MeshData all;
    all.mesh = box(1, 2, 3);
    all.lines = {all.mesh.positions, {{0, 1, 2}, {3, 4}}};
    all.point_arrays = {{"depth", 1, std::vector<double>(8, 0.5)},
                        {"Normals", 3, std::vector<double>(24, 1)},
                        {"RGB", 3, std::vector<double>(24, 200)}};
    std::vector<std::pair<std::string, std::string>> out;
    for (const MeshFormat& format : mesh_formats()) {
        MeshData data = all;
        fit_to_format(data, format);
        out.emplace_back("own" + format.extensions[0], written(format, data));
    }
    out.emplace_back("rich.vtk", legacy_ascii());
    out.emplace_back("rich_binary.vtk", legacy_binary());
    out.emplace_back("rich.obj",
                     "mtllib a\nv 0 0 0 1 1 1\nv 1 0 0\nvt 0 0\nvn 0 0 1\nv 0 1 0\nv 1 1 0\nusemtl b\n"
                     "f 1/1/1 2//1 3/1 \\\n -1\ng x y\nl 1 2 -1\ns 1\nf -4 -3 -2\n");
    out.emplace_back("rich.vtp", vtp_inline());
    out.emplace_back("rich_appended.vtp", vtp_appended());
    out.emplace_back("rich.ply", ply_ascii());
    out.emplace_back("rich_big_endian.ply", ply_big_endian());
    out.emplace_back("rich.stl",
                     "solid a b\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
                     "endloop\nendfacet\nendsolid a b\nsolid\nfacet normal nan 0 0\nouter loop\nvertex 1 0 "
                     "0\nvertex 1 1 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n");
    out.emplace_back("rich.off",
                     "# c\nCNOFF # d\n4 3 0\n0 0 0 0 0 1 255 0 0 255\n1 0 0 0 0 1 255 0 0 255\n"
                     "1 1 0 0 0 1 1 2 3 4\n0 1 0 0 0 1 1 2 3 4\n4 0 1 2 3 0.5 0.5 0.5\n3 0 2 1\n2 0 2\n");
    return out;
}

} // namespace fascicle::test
