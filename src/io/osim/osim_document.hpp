#pragma once
// An .osim file as a tree of elements, with values that are checked where they are read.

#include "fascicle/base/types.hpp"

#include <map>
#include <pugixml.hpp>
#include <string>
#include <string_view>

namespace fascicle::io {

class OsimDocument {
public:
    /// Error when the text is not well-formed or too large. `bytes` must outlive the document.
    OsimDocument(std::string_view bytes, std::string file);

    pugi::xml_node root() const { return document_.document_element(); }
    const std::string& file() const { return file_; }

    /// "file, line 7: what; expected ...", at an element.
    [[noreturn]] void fail(pugi::xml_node node, const std::string& what,
                           const std::string& expected = {}) const;

    /// Text of a child element without white space at its ends; empty when there is no such child.
    static std::string_view text(pugi::xml_node parent, const char* child);
    /// The first of the children that is there.
    static pugi::xml_node first_of(pugi::xml_node parent, std::initializer_list<const char*> children);
    static pugi::xml_node first_element(pugi::xml_node parent);
    /// Name attribute, "" without.
    static std::string name(pugi::xml_node node) { return node.attribute("name").value(); }

    /// Numbers of a child element; empty when it is not there. Error for what is no number, or not finite.
    std::vector<double> numbers(pugi::xml_node parent, const char* child) const;
    std::vector<double> numbers(pugi::xml_node element) const;
    /// Exactly `count` of them; empty when the child is not there.
    std::vector<double> numbers(pugi::xml_node parent, const char* child, std::size_t count) const;
    double number(pugi::xml_node parent, const char* child, double otherwise) const;
    Vec3 vector(pugi::xml_node parent, const char* child, const Vec3& otherwise) const;
    bool flag(pugi::xml_node parent, const char* child, bool otherwise) const;

private:
    std::size_t line_of(std::ptrdiff_t offset) const;
    std::string_view bytes_;
    std::string file_;
    pugi::xml_document document_;
};

/// Element children of a set: of its `objects`, or its own where it has none.
std::vector<pugi::xml_node> members(pugi::xml_node set);

/// Counts what is passed over, for one note each kind.
class PassedOver {
public:
    void add(const std::string& what) { ++counts_[what]; }
    void write(std::vector<std::string>& notes) const {
        for (const auto& [what, count] : counts_)
            notes.push_back(
                "passed over: " + (count > 1 ? std::to_string(count) + " times " : std::string()) + what);
    }

private:
    std::map<std::string, int> counts_;
};

} // namespace fascicle::io
