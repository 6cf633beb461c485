#include "fascicle/io/series_file.hpp"

#include "fascicle/io/files.hpp"
#include "io/formats/pvd.hpp"

namespace fascicle {

void write_series_file(const std::filesystem::path& path,
                       const std::vector<std::pair<double, std::string>>& series) {
    AtomicFile file(path);
    io::write_pvd(file.stream(), series);
    file.commit();
}

} // namespace fascicle
