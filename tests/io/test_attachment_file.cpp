#include "fascicle/base/error.hpp"
#include "fascicle/io/attachment_file.hpp"
#include "support/data_dir.hpp"

#include <catch2/catch.hpp>
#include <random>

using namespace fascicle;
using Catch::Matchers::Contains;

namespace {

auto read(const std::string& text, LengthUnit unit = LengthUnit::millimetre) {
    return read_attachments(text, "a.csv", unit);
}

} // namespace

TEST_CASE("attachments: rows that belong together make one outline", "[io][attachment_file]") {
    const auto outlines = read("attachment,bone,x_mm,y_mm,z_mm\norigin,pelvis,1,2,3\norigin,pelvis,4,5,6\n"
                               "origin,sacrum,7,8,9\ninsertion,femur,1,1,1\norigin,pelvis,0,0,0\n");
    REQUIRE(outlines.size() == 4);
    CHECK(outlines[0].kind == AttachmentKind::origin);
    CHECK(outlines[0].bone == "pelvis");
    CHECK(outlines[0].points == Points{Vec3(1, 2, 3), Vec3(4, 5, 6)});
    CHECK(outlines[1].bone == "sacrum");
    CHECK(outlines[2].kind == AttachmentKind::insertion);
    CHECK(outlines[3].points.size() == 1);
}

TEST_CASE("attachments: units of the columns and of the scene", "[io][attachment_file]") {
    const auto first = [](const std::string& header, LengthUnit unit) {
        return read(header + "\norigin,b,1000,2000,-500\n", unit)[0].points[0];
    };
    const auto mm = LengthUnit::millimetre, m = LengthUnit::metre;
    CHECK(first("attachment,bone,x_mm,y_mm,z_mm", mm) == Vec3(1000, 2000, -500));
    CHECK((first("attachment,bone,x_mm,y_mm,z_mm", m) - Vec3(1, 2, -0.5)).norm() < 1e-12);
    CHECK(first("attachment,bone,x_m,y_m,z_m", mm) == Vec3(1e6, 2e6, -5e5));
    CHECK(first("attachment,bone,x_cm,y_cm,z_cm", mm) == Vec3(1e4, 2e4, -5e3));
    CHECK(first("Attachment,Bone,X [mm],Y [mm],Z [mm]", mm) == Vec3(1000, 2000, -500));
    CHECK(first("attachment,bone,x (m),y (m),z (m)", m) == Vec3(1000, 2000, -500));
    CHECK(first("attachment,bone,x,y,z", m) == Vec3(1000, 2000, -500));
}

TEST_CASE("attachments: semicolons, decimal commas, column order, further columns", "[io][attachment_file]") {
    const auto outlines = read(
        "\xef\xbb\xbfz_mm;y_mm;x_mm;note;bone;attachment\r\n3,5;2,5;1,5;\"a;b\";femur;Insertion\r\n\r\n");
    REQUIRE(outlines.size() == 1);
    CHECK(outlines[0].points == Points{Vec3(1.5, 2.5, 3.5)});
    CHECK(outlines[0].kind == AttachmentKind::insertion);
}

TEST_CASE("attachments: mistakes name the line", "[io][attachment_file]") {
    const std::string head = "attachment,bone,x_mm,y_mm,z_mm\n";
    CHECK_THROWS_WITH(read(""), Contains("a.csv"));
    CHECK_THROWS_WITH(read(head), Contains("the table has no rows"));
    CHECK_THROWS_WITH(read("bone,x_mm,y_mm,z_mm\n"), Contains("column 'attachment'"));
    CHECK_THROWS_WITH(read("attachment,x_mm,y_mm,z_mm\n"), Contains("column 'bone'"));
    CHECK_THROWS_WITH(read("attachment,bone,x_mm,y_m,z_mm\n"), Contains("columns x, y and z of one unit"));
    CHECK_THROWS_WITH(read(head + "origin,a,1,2,3\nOrigins,a,1,2,3\n"),
                      Contains("a.csv, line 3: attachment is 'Origins'"));
    CHECK_THROWS_WITH(read(head + "origin,,1,2,3\n"), Contains("line 2: no bone"));
    CHECK_THROWS_WITH(read(head + "origin,a,1,x,3\n"), Contains("line 2: got 'x' in column 'y_mm'"));
    CHECK_THROWS_WITH(read(head + "origin,a,1,2\n"), Contains("line 2"));
}

TEST_CASE("attachments: damaged tables end in outlines or an Error", "[io][attachment_file]") {
    const std::string good =
        "\xef\xbb\xbf"
        "attachment;bone;x_mm;y_mm;z_mm\r\norigin;\"a \"\"b\"\"\";1,5;2;3\r\ninsertion;c;4;5;6e1\r\n";
    std::mt19937 random(1);
    for (int round = 0; round < 5000; ++round) {
        std::string bytes = good;
        for (unsigned k = random() % 4; k > 0; --k) {
            const std::size_t at = random() % bytes.size();
            if (random() % 2 == 0)
                bytes[at] = static_cast<char>(random());
            else
                bytes.erase(at, random() % 5);
        }
        try {
            for (const AttachmentOutline& outline : read(bytes))
                for (const Vec3& p : outline.points)
                    REQUIRE(p.allFinite());
        } catch (const Error& error) {
            REQUIRE(std::string(error.what()).find('\n') == std::string::npos);
        }
    }
}

TEST_CASE("LHDL attachment tables read", "[io][attachment_file][data]") {
    FASCICLE_NEED_DATA(data);
    const auto gluteus =
        read_attachment_file(data / "lhdl/gluteus_maximus_attachments.csv", LengthUnit::millimetre);
    std::size_t points = 0;
    for (const AttachmentOutline& outline : gluteus)
        points += outline.points.size();
    CHECK(gluteus.size() == 3);
    CHECK(points >= 50);
    CHECK(gluteus[0].bone == "right_iliac");
    CHECK(read_attachment_file(data / "lhdl/iliacus_attachments.csv", LengthUnit::millimetre).size() == 2);
}
