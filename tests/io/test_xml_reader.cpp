// The pull parser of VTP and PVD: events, attributes, what is refused.
#include "fascicle/base/error.hpp"
#include "io/formats/xml_reader.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;
using io::XmlReader;
using Event = XmlReader::Event;
using Catch::Matchers::Contains;

namespace {

/// The attribute `a` of the only element.
std::string attribute_of(const std::string& written) {
    const std::string text = "<e a=\"" + written + "\"/>";
    XmlReader xml(text, "a.xml");
    xml.next();
    return xml.attribute("a");
}

void read_all(const std::string& text) {
    XmlReader xml(text, "a.xml");
    while (xml.next() != Event::finished) {
    }
}

} // namespace

TEST_CASE("xml reader: the five entities of an attribute are replaced, once", "[io]") {
    CHECK(attribute_of("") == "");
    CHECK(attribute_of("plain") == "plain");
    CHECK(attribute_of("&lt;&gt;&quot;&apos;&amp;") == "<>\"'&");
    CHECK(attribute_of("1 &lt; 2 &amp;&amp; 3") == "1 < 2 && 3");
    CHECK(attribute_of("&amp;lt;") == "&lt;");
    CHECK(attribute_of("&#65; &lol; & &lt") == "&#65; &lol; & &lt"); // no entity of ours stays as it is
    const std::string any = "a<b>&\"'c";
    CHECK(attribute_of(io::xml_escaped(any)) == any);
}

TEST_CASE("xml reader: events in order, positions, text as it stands", "[io]") {
    const std::string text =
        "<?xml version=\"1.0\"?>\n<!-- no <element> -->\n<a x='1' y = \"2\">\n t &lt; <b/></a>\n";
    XmlReader xml(text, "a.xml");
    REQUIRE(xml.next() == Event::start);
    CHECK((xml.name() == "a" && xml.attribute("x") == "1" && xml.attribute("y") == "2"));
    CHECK((xml.has_attribute("x") && !xml.has_attribute("z") && xml.attribute("z").empty()));
    CHECK(text.compare(xml.position(), 2, "<a") == 0);
    REQUIRE(xml.next() == Event::text);
    CHECK(xml.text() == "t &lt;");
    REQUIRE(xml.next() == Event::start);
    CHECK((xml.name() == "b" && !xml.has_attribute("x")));
    REQUIRE(xml.next() == Event::end);
    REQUIRE(xml.next() == Event::end);
    CHECK(xml.name() == "a");
    CHECK(xml.next() == Event::finished);
}

TEST_CASE("xml reader: an element is skipped with all that it holds", "[io]") {
    const std::string text = "<a><b><c>1</c><c/></b><d/></a>";
    XmlReader xml(text, "a.xml");
    xml.next();
    xml.next();
    REQUIRE(xml.name() == "b");
    xml.skip_element();
    REQUIRE(xml.next() == Event::start);
    CHECK(xml.name() == "d");
}

TEST_CASE("xml reader: what is not well-formed, or has a document type, is an error with its line", "[io]") {
    for (const char* text : {"<a>", "<a", "<a></b>", "</a>", "text", "<a b></a>", "<a b=1/>", "<a b=\"1/>",
                             "<!-- open", "<>", "<!DOCTYPE a><a/>", "<a><![CDATA[x]]></a>"})
        CHECK_THROWS_AS(read_all(text), Error);
    CHECK_THROWS_WITH(read_all("<a>\n<b></a>"), Contains("a.xml, line 2"));
    std::string deep;
    for (int i = 0; i < 101; ++i)
        deep += "<a>";
    CHECK_THROWS_WITH(read_all(deep), Contains("100 levels"));
}
