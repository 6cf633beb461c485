#include "io/formats/pvd.hpp"

#include "fascicle/base/param_table.hpp"
#include "io/formats/xml_reader.hpp"

namespace fascicle::io {

void write_pvd(std::ostream& out, const std::vector<std::pair<double, std::string>>& series) {
    out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
    for (const auto& [time, file] : series)
        out << "<DataSet timestep=\"" << number_text(time) << "\" group=\"\" part=\"0\" file=\""
            << xml_escaped(file) << "\"/>\n";
    out << "</Collection>\n</VTKFile>\n";
}

} // namespace fascicle::io
