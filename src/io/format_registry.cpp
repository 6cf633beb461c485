#include "fascicle/io/format_registry.hpp"

#include "fascicle/base/error.hpp"
#include "io/formats/gltf_read.hpp"
#include "io/formats/gltf_write.hpp"
#include "io/formats/obj.hpp"
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
        {"VTK legacy", {".vtk"}, io::looks_like_vtk_legacy, io::read_vtk_legacy, io::write_vtk_legacy},
        {"VTK XML", {".vtp"}, io::looks_like_vtp, io::read_vtp, io::write_vtp},
        {"glTF 2.0", {".glb"}, io::looks_like_glb, io::read_glb_mesh, io::write_glb_mesh},
        {"USD text", {".usda"}, io::looks_like_usda, io::read_usda_mesh, io::write_usda_mesh},
        {"OBJ", {".obj"}, io::looks_like_obj, io::read_obj, io::write_obj},
    };
    return formats;
}

const MeshFormat* recognise_format(std::string_view bytes, const std::filesystem::path& file) {
    for (const MeshFormat& format : mesh_formats())
        if (format.recognises(bytes))
            return &format;
    return by_extension(file);
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
