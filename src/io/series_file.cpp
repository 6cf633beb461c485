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

std::vector<std::pair<double, std::string>> parse_series(std::string_view bytes, const std::string& file) {
    return io::read_pvd(bytes, file);
}

bool looks_like_series(std::string_view bytes) {
    return io::looks_like_pvd(bytes);
}

} // namespace fascicle
