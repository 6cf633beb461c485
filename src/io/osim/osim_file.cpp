#include "fascicle/io/osim_file.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/io/files.hpp"
#include "io/formats/text_scanner.hpp"
#include "io/osim/osim_reader.hpp"

namespace fascicle {
namespace io {

void OsimReader::read() {
    const pugi::xml_node root = document_.root();
    long long version = 0;
    if (std::string_view(root.name()) != "OpenSimDocument" ||
        to_integer(root.attribute("Version").value(), version) != NumberCheck::ok)
        throw_error(document_.file(), "is no OpenSim model", "an element OpenSimDocument with a Version");
    if (version < 20300 || version >= 50000)
        document_.fail(root, "the file's version is " + std::to_string(version),
                       "20300 to 49999 (OpenSim 2.3 to 4)");
    result_.version = static_cast<int>(version);
    const pugi::xml_node model = root.child("Model");
    if (!model)
        document_.fail(root, "the document holds no Model", "an element Model");
    result_.model.name = OsimDocument::name(model);
    const std::string unit = lower_case(OsimDocument::text(model, "length_units"));
    if (!unit.empty() && unit != "meters" && unit != "m")
        result_.notes.push_back("length_units is " + shown(unit) +
                                ": lengths are taken for metres all the same");
    read_bodies(model);
    read_joints(model);
    read_couplers(model);
    read_muscles(model);
    for (std::string& note : arrange_skeleton(skeleton_, document_.file()))
        result_.notes.push_back(std::move(note));
    passed_over_.write(result_.notes);
}

} // namespace io

OsimModel read_osim(std::string_view bytes, const std::string& file) {
    const io::OsimDocument document(bytes, file);
    OsimModel result;
    io::OsimReader(document, result).read();
    return result;
}

OsimModel read_osim_file(const std::filesystem::path& path) {
    return read_osim(read_file(path, std::size_t{128} << 20), path.string());
}

} // namespace fascicle
