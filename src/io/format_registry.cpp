#include "fascicle/io/format_registry.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/io/files.hpp"
#include "io/formats/gltf_read.hpp"
#include "io/formats/gltf_write.hpp"
#include "io/formats/obj.hpp"
#include "io/formats/off.hpp"
#include "io/formats/ply.hpp"
#include "io/formats/stl.hpp"
#include "io/formats/text_scanner.hpp"
#include "io/formats/usda_read.hpp"
#include "io/formats/usda_write.hpp"
#include "io/formats/vtk_legacy.hpp"
#include "io/formats/vtp.hpp"

#include <algorithm>

namespace fascicle {
namespace {

const MeshFormat* by_extension(const std::filesystem::path& file) {
    const std::string extension = io::lower_case(file.extension().string());
    for (const MeshFormat& format : mesh_formats())
        if (std::count(format.extensions.begin(), format.extensions.end(), extension) > 0)
            return &format;
    return nullptr;
}

} // namespace

const std::vector<MeshFormat>& mesh_formats() {
    // In the order in which content is tried: OBJ last, since it has no mark of its own.
    static const std::vector<MeshFormat> formats{
        {"VTK legacy",
         {".vtk"},
         io::looks_like_vtk_legacy,
         io::read_vtk_legacy,
         io::write_vtk_legacy,
         {.point_arrays = true, .lines = true, .line_arrays = true}},
        {"VTK XML",
         {".vtp"},
         io::looks_like_vtp,
         io::read_vtp,
         io::write_vtp,
         {.point_arrays = true, .lines = true, .line_arrays = true}},
        {"PLY",
         {".ply"},
         io::looks_like_ply,
         io::read_ply,
         io::write_ply,
         {.point_arrays = true, .lines = true, .long_lines = false}},
        {"STL",
         {".stl"},
         io::looks_like_stl,
         io::read_stl,
         io::write_stl,
         {.doubles = false, .vertex_order = false}},
        {"OFF", {".off"}, io::looks_like_off, io::read_off, io::write_off, {.colours = true}},
        {"glTF 2.0",
         {".glb"},
         io::looks_like_glb,
         io::read_glb_mesh,
         io::write_glb_mesh,
         {.lines = true, .doubles = false, .metres = true}},
        {"USD text",
         {".usda"},
         io::looks_like_usda,
         io::read_usda_mesh,
         io::write_usda_mesh,
         {.lines = true, .doubles = false, .metres = true}},
        {"OBJ", {".obj"}, io::looks_like_obj, io::read_obj, io::write_obj, {.lines = true}},
    };
    return formats;
}

const MeshFormat* recognise_format(std::string_view bytes, const std::filesystem::path& file) {
    for (const MeshFormat& format : mesh_formats())
        if (format.recognises(bytes))
            return &format;
    return by_extension(file);
}

const MeshFormat* recognise_file(const std::filesystem::path& file) {
    const std::string head = read_head(file, std::size_t{1} << 16);
    if (head.empty())
        return nullptr;
    std::error_code code;
    const std::uintmax_t size = std::filesystem::file_size(file, code);
    // Of binary STL nothing but the size tells, and that of the beginning is another.
    if (!code && size > head.size() && io::has_size_of_binary_stl(head, size))
        for (const MeshFormat& format : mesh_formats())
            if (format.extensions.front() == ".stl")
                return &format;
    return recognise_format(head, file);
}

std::vector<std::string> mesh_extensions() {
    std::vector<std::string> all;
    for (const MeshFormat& format : mesh_formats())
        all.insert(all.end(), format.extensions.begin(), format.extensions.end());
    return all;
}

std::string mesh_format_names() {
    std::string all;
    for (const MeshFormat& format : mesh_formats())
        all += (all.empty() ? "" : ", ") + format.name;
    return all;
}

const MeshFormat& format_for_writing(const std::filesystem::path& file) {
    const MeshFormat* format = by_extension(file);
    if (format == nullptr || !format->write) {
        std::string known;
        for (const MeshFormat& f : mesh_formats())
            if (f.write)
                for (const std::string& extension : f.extensions)
                    known += (known.empty() ? "" : ", ") + extension;
        throw_error(file.string(), "unknown file extension '" + file.extension().string() + "'",
                    "one of " + known, ErrorKind::usage);
    }
    return *format;
}

} // namespace fascicle
