#include "io/formats/pvd.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/base/param_table.hpp"
#include "io/formats/text_scanner.hpp"
#include "io/formats/xml_reader.hpp"

#include <cmath>

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
    std::vector<std::pair<double, std::string>> series;
    std::string outer[2];
    std::size_t depth = 0;
    for (auto event = xml.next(); event != XmlReader::Event::finished; event = xml.next()) {
        if (event == XmlReader::Event::end)
            --depth;
        if (event != XmlReader::Event::start)
            continue;
        if (depth < 2)
            outer[depth] = xml.name();
        if (depth == 0 && (xml.name() != "VTKFile" || xml.attribute("type") != "Collection"))
            xml.fail("not a series of files", "<VTKFile type=\"Collection\">");
        if (depth == 2 && outer[1] == "Collection" && xml.name() == "DataSet") {
            const std::string text = xml.attribute("timestep");
            double time = 0;
            if (!text.empty() && (to_double(trimmed(text), time) != NumberCheck::ok || !std::isfinite(time)))
                xml.fail("timestep is " + shown(text), "a number");
            if (xml.attribute("file").empty())
                xml.fail("a step without a file", "file=\"NAME\"");
            series.emplace_back(time, xml.attribute("file"));
        }
        ++depth;
    }
    if (outer[0].empty())
        xml.fail("not a series of files", "<VTKFile type=\"Collection\">");
    return series;
}

bool looks_like_pvd(std::string_view bytes) {
    const std::string_view head = trimmed(bytes.substr(0, 4096));
    const std::size_t at = head.find("<VTKFile");
    return head.substr(0, 1) == "<" && at != std::string_view::npos &&
           head.substr(at, head.find('>', at) - at).find("\"Collection\"") != std::string_view::npos;
}

} // namespace fascicle::io
