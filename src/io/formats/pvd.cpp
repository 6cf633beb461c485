#include "io/formats/pvd.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/base/param_table.hpp"
#include "io/formats/text_scanner.hpp"
#include "io/formats/xml_reader.hpp"

#include <cmath>
#include <filesystem>

namespace fascicle::io {

void write_pvd(std::ostream& out, const std::vector<std::pair<double, std::string>>& series) {
    out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
    for (const auto& [time, file] : series)
        out << "<DataSet timestep=\"" << number_text(time) << "\" group=\"\" part=\"0\" file=\""
            << xml_escaped(file) << "\"/>\n";
    out << "</Collection>\n</VTKFile>\n";
}

std::vector<std::pair<double, std::string>> read_pvd(std::string_view bytes, const std::string& file) {
    XmlReader xml(bytes, file);
    std::vector<std::pair<double, std::string>> out;
    int depth = 0;
    for (XmlReader::Event event = xml.next(); event != XmlReader::Event::finished; event = xml.next()) {
        if (event == XmlReader::Event::end) {
            --depth;
            continue;
        }
        if (event != XmlReader::Event::start)
            continue;
        ++depth;
        if (depth == 1 && (xml.name() != "VTKFile" || xml.attribute("type") != "Collection"))
            xml.fail("not a series of ParaView", "<VTKFile type=\"Collection\">");
        if (xml.name() != "DataSet")
            continue;
        double time = 0;
        if (to_double(xml.attribute("timestep"), time) != NumberCheck::ok || !std::isfinite(time))
            xml.fail("a bad timestep: " + shown(xml.attribute("timestep")), "a number");
        if (!out.empty() && !(time > out.back().first))
            xml.fail("a timestep that is not after the one before", "ascending times, one part each");
        const std::filesystem::path name = xml.attribute("file");
        bool outside = name.empty() || name.is_absolute();
        for (const auto& part : name)
            outside = outside || part == "..";
        if (outside)
            xml.fail("the file " + shown(xml.attribute("file")) + " is not below the series' folder",
                     "a relative name");
        out.emplace_back(time, xml.attribute("file"));
    }
    if (out.empty())
        throw_error(file, "the series names no files", "DataSet elements");
    return out;
}

} // namespace fascicle::io
