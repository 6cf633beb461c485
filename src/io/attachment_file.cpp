#include "fascicle/io/attachment_file.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/io/csv.hpp"
#include "fascicle/io/files.hpp"
#include "io/formats/text_scanner.hpp"

#include <algorithm>

namespace fascicle {
namespace {

struct Columns {
    int attachment = -1, bone = -1, head = -1, loop = -1, hole = -1;
    int xyz[3] = {-1, -1, -1};
    double scale = 1.0; ///< of a value to scene units
};

Columns find_columns(const CsvReader& csv, LengthUnit scene_unit) {
    std::vector<std::string> names;
    for (const std::string& name : csv.columns())
        names.push_back(plain_column(name));
    const auto find = [&](const std::string& name) {
        const auto it = std::find(names.begin(), names.end(), name);
        return it == names.end() ? -1 : static_cast<int>(it - names.begin());
    };
    Columns columns;
    columns.attachment = find("attachment");
    columns.bone = find("bone");
    columns.head = find("head");
    columns.loop = find("loop");
    columns.hole = find("hole");
    const double scene_mm = millimetres_per_unit(scene_unit);
    const std::pair<const char*, double> units[] = {
        {"_mm", 1.0}, {"_cm", 10.0}, {"_m", 1000.0}, {"", scene_mm}};
    for (const auto& [suffix, mm] : units) {
        const int x = find(std::string("x") + suffix), y = find(std::string("y") + suffix),
                  z = find(std::string("z") + suffix);
        if (x >= 0 && y >= 0 && z >= 0 && columns.xyz[0] < 0) {
            columns.xyz[0] = x;
            columns.xyz[1] = y;
            columns.xyz[2] = z;
            columns.scale = mm / scene_mm;
        }
    }
    if (columns.attachment < 0 || columns.bone < 0 || columns.xyz[0] < 0)
        csv.fail("the header lacks " + std::string(columns.attachment < 0 ? "column 'attachment'"
                                                   : columns.bone < 0     ? "column 'bone'"
                                                                          : "columns x, y and z of one unit"),
                 "a header row such as attachment,bone,x_mm,y_mm,z_mm");
    return columns;
}

} // namespace

std::vector<AttachmentOutline> read_attachments(std::string_view bytes, const std::string& file,
                                                LengthUnit scene_unit) {
    CsvReader csv(bytes, file);
    const Columns columns = find_columns(csv, scene_unit);
    std::vector<AttachmentOutline> outlines;
    std::string loop_before;
    while (csv.next_row()) {
        const std::string kind_text = io::lower_case(csv.cell(columns.attachment));
        AttachmentKind kind = AttachmentKind::unknown;
        for (const AttachmentKind known : {AttachmentKind::origin, AttachmentKind::insertion})
            if (kind_text == to_text(known))
                kind = known;
        if (kind == AttachmentKind::unknown)
            csv.fail("attachment is " + io::shown(csv.cell(columns.attachment)), "origin or insertion");
        const std::string& bone = csv.cell(columns.bone);
        if (bone.empty())
            csv.fail("no bone", "the name of a bone");
        Vec3 p;
        for (int k = 0; k < 3; ++k)
            p[k] = columns.scale * csv.number(columns.xyz[k]);
        if (!p.allFinite())
            csv.fail("the point overflows", "smaller coordinates");
        const std::string head = columns.head >= 0 ? csv.cell(columns.head) : std::string();
        const std::string loop = columns.loop >= 0 ? csv.cell(columns.loop) : std::string();
        bool hole = false;
        if (columns.hole >= 0 && !csv.cell(columns.hole).empty()) {
            const double flag = csv.number(columns.hole);
            if (flag != 0.0 && flag != 1.0)
                csv.fail("hole is " + io::shown(csv.cell(columns.hole)), "0 or 1");
            hole = flag == 1.0;
        }
        if (outlines.empty() || outlines.back().kind != kind || outlines.back().bone != bone ||
            outlines.back().head != head || outlines.back().hole != hole || loop != loop_before)
            outlines.push_back({kind, bone, {}, head, hole});
        loop_before = loop;
        outlines.back().points.push_back(p);
    }
    if (outlines.empty())
        throw_error(file, "the table has no rows", "outline points");
    return outlines;
}

std::vector<AttachmentOutline> read_attachment_file(const std::filesystem::path& path,
                                                    LengthUnit scene_unit) {
    return read_attachments(read_file(path), path.string(), scene_unit);
}

} // namespace fascicle
