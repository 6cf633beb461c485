#include "fascicle/io/mesh_stamp.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/base/param_table.hpp"
#include "fascicle/io/files.hpp"
#include "io/formats/text_scanner.hpp"
#include "io/formats/vtp_field_data.hpp"

#include <sstream>

namespace fascicle {
namespace {

using Insert = void (*)(std::string& bytes, const MeshStamp& stamp);

/// "SPACE=LPS", "1 unit = 1000 mm", "up y": what find_mesh_stamp finds.
std::vector<std::string> words_of(const MeshStamp& stamp) {
    std::vector<std::string> words;
    if (stamp.hints.space)
        words.push_back(std::string("SPACE=") + to_text(*stamp.hints.space));
    if (stamp.hints.millimetres)
        words.push_back("1 unit = " + number_text(*stamp.hints.millimetres) + " mm");
    if (stamp.up)
        words.push_back(std::string("up ") + *stamp.up);
    return words;
}

std::string lines_of(const MeshStamp& stamp, const std::string& before) {
    std::string lines;
    for (const std::string& word : words_of(stamp))
        lines += before + word + '\n';
    return lines;
}

std::string title_of(const MeshStamp& stamp) {
    std::string title;
    for (const std::string& word : words_of(stamp))
        title += "; " + word;
    return title;
}

void insert_behind(std::string& bytes, std::string_view mark, const std::string& text) {
    const std::size_t at = bytes.find(mark);
    FASCICLE_ASSERT(at != std::string::npos); // our own writer's
    bytes.insert(at + mark.size(), text);
}

void into_obj(std::string& bytes, const MeshStamp& stamp) {
    bytes.insert(0, lines_of(stamp, "# "));
}

void into_off(std::string& bytes, const MeshStamp& stamp) {
    insert_behind(bytes, "OFF\n", lines_of(stamp, "# "));
}

void into_ply(std::string& bytes, const MeshStamp& stamp) {
    insert_behind(bytes, "comment written by fascicle\n", lines_of(stamp, "comment "));
}

void into_vtk(std::string& bytes, const MeshStamp& stamp) {
    insert_behind(bytes, "written by fascicle", title_of(stamp));
}

void into_stl(std::string& bytes, const MeshStamp& stamp) {
    constexpr std::size_t header = 80;
    const std::string text = ("written by fascicle" + title_of(stamp)).substr(0, header);
    bytes.replace(0, text.size(), text);
}

void into_vtp(std::string& bytes, const MeshStamp& stamp) {
    insert_behind(bytes, "<PolyData>\n", io::vtp_field_data_text(stamp));
}

void into_usda(std::string& bytes, const MeshStamp& stamp) {
    const auto replace = [&](std::string_view key, const std::string& value) {
        const std::size_t at = bytes.find(key);
        FASCICLE_ASSERT(at != std::string::npos);
        const std::size_t start = at + key.size();
        bytes.replace(start, bytes.find('\n', start) - start, value);
    };
    if (stamp.hints.millimetres)
        replace("metersPerUnit = ", number_text(*stamp.hints.millimetres / 1000));
    if (stamp.up)
        replace("upAxis = ", *stamp.up == 'y' ? "\"Y\"" : "\"Z\"");
}

struct Place {
    std::string_view extension; ///< the usual one of the format
    Insert insert;              ///< null: there is no place
    bool unit, space;           ///< what there is a place for
};
constexpr Place places[] = {{".obj", into_obj, true, true},    {".off", into_off, true, true},
                            {".ply", into_ply, true, true},    {".vtk", into_vtk, true, true},
                            {".stl", into_stl, true, true},    {".vtp", into_vtp, true, true},
                            {".usda", into_usda, true, false}, {".glb", nullptr, false, false}};

const Place& place_in(const MeshFormat& format) {
    for (const Place& place : places)
        if (format.extensions.front() == place.extension)
            return place;
    static constexpr Place none{"", nullptr, false, false};
    return none;
}

} // namespace

const char* to_text(MeshSpace space) {
    return space == MeshSpace::ras ? "RAS" : "LPS";
}

std::optional<char> find_up_axis(std::string_view bytes) {
    if (bytes.substr(0, 4) == "glTF")
        return 'y';
    if (io::is_vtp_with_field_data(bytes))
        return io::read_vtp_field_data(bytes).up;
    const std::string_view head = bytes.substr(0, 4096);
    if (io::trimmed(head).substr(0, 5) == "#usda") // Y where nothing is said, as USD has it
        return head.find("upAxis = \"Z\"") != std::string_view::npos ? 'z' : 'y';
    for (const std::string_view before : {"# ", "comment ", "; "})
        for (const char axis : {'y', 'z'})
            if (head.find(std::string(before) + "up " + axis) != std::string_view::npos)
                return axis;
    return std::nullopt;
}

MeshStamp find_mesh_stamp(std::string_view bytes) {
    return {find_mesh_hints(bytes), find_up_axis(bytes)};
}

MeshStamp read_mesh_stamp(const std::filesystem::path& path) {
    const std::string head = read_head(path, std::size_t{1} << 16);
    if (!io::is_vtp_with_field_data(head))
        return find_mesh_stamp(head);
    try { // its data may be appended behind everything
        return find_mesh_stamp(read_file(path));
    } catch (const Error&) {
        return {};
    }
}

void write_stamped(std::ostream& out, const MeshFormat& format, const MeshData& data,
                   const MeshStamp& stamp) {
    const Place& place = place_in(format);
    if (stamp.empty() || place.insert == nullptr)
        return format.write(out, data);
    std::ostringstream text;
    format.write(text, data);
    std::string bytes = std::move(text).str();
    place.insert(bytes, stamp);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

void write_stamped_file(const std::filesystem::path& path, const MeshData& data, const MeshStamp& stamp) {
    const MeshFormat& format = format_for_writing(path);
    AtomicFile file(path);
    write_stamped(file.stream(), format, data, stamp);
    file.commit();
}

MeshStamp stamp_of(LengthUnit unit) {
    MeshStamp stamp;
    stamp.hints.millimetres = millimetres_per_unit(unit);
    return stamp;
}

std::vector<std::string> lost_of_stamp(const MeshFormat& format, const MeshStamp& stamp) {
    const Place& place = place_in(format);
    std::vector<std::string> lost;
    if (stamp.hints.space && !place.space)
        lost.push_back((*stamp.hints.space == MeshSpace::ras ? "dropped: SPACE=RAS, which "
                                                             : "dropped: SPACE=LPS, which ") +
                       format.name + " has no place for");
    if (stamp.hints.millimetres && !place.unit && !format.holds.metres)
        lost.push_back("dropped: the unit, which " + format.name + " has no place for");
    return lost;
}

} // namespace fascicle
