// Functions of coordinates, and coordinates by name.

#include "fascicle/base/suggest.hpp"
#include "io/formats/text_scanner.hpp"
#include "io/osim/osim_reader.hpp"

namespace fascicle::io {
namespace {

constexpr const char* known_functions =
    "Constant, LinearFunction, PolynomialFunction, SimmSpline, NaturalCubicSpline, "
    "PiecewiseLinearFunction or MultiplierFunction";

/// <function><X/></function>, or <X name="function"/>, or the only element of a holder that is nothing but that.
pugi::xml_node function_element(pugi::xml_node holder) {
    for (const pugi::xml_node child : holder.children())
        if (child.type() == pugi::node_element && OsimDocument::name(child) == "function")
            return child;
    if (const pugi::xml_node wrapped = holder.child("function"))
        return OsimDocument::first_element(wrapped);
    if (holder.child("axis") || holder.child("coordinates")) // a TransformAxis without a function
        return {};
    return OsimDocument::first_element(holder);
}

} // namespace

int OsimReader::coordinate_named(std::string_view reference, pugi::xml_node node) const {
    std::string name(trimmed(reference));
    name = name.substr(name.find_last_of('/') + 1);
    const int index = skeleton_.coordinate_index(name);
    if (index < 0) {
        std::vector<std::string> names;
        for (const Coordinate& c : skeleton_.coordinates)
            names.push_back(c.name);
        document_.fail(node, "there is no coordinate " + shown(name) + did_you_mean(name, names));
    }
    return index;
}

std::vector<int> OsimReader::coordinates_named(pugi::xml_node names) const {
    std::vector<int> found;
    TextScanner words(names.text().get(), document_.file());
    for (std::string_view word; !(word = words.next_word()).empty();)
        found.push_back(coordinate_named(word, names));
    return found;
}

JointFunction OsimReader::read_one(pugi::xml_node node, int depth) {
    const std::string_view type = node.name();
    if (type == "Constant")
        return JointFunction::constant(document_.number(node, "value", 0));
    if (type == "LinearFunction") {
        const std::vector<double> c = document_.numbers(node, "coefficients", 2);
        return c.empty() ? JointFunction::linear(1, 0) : JointFunction::linear(c[0], c[1]);
    }
    if (type == "PolynomialFunction")
        return JointFunction::polynomial(document_.numbers(node, "coefficients"));
    if (type == "MultiplierFunction") {
        const pugi::xml_node inner = function_element(node);
        if (!inner || depth > 16)
            document_.fail(node, "a MultiplierFunction of nothing", "a function and a scale");
        return read_one(inner, depth + 1).scaled(document_.number(node, "scale", 1));
    }
    const bool simm = type == "SimmSpline", linear = type == "PiecewiseLinearFunction";
    if (!simm && !linear && type != "NaturalCubicSpline" && type != "natCubicSpline")
        document_.fail(node, "a function of the kind " + shown(type), known_functions);
    const std::vector<double> x = document_.numbers(node, "x"), y = document_.numbers(node, "y");
    if (x.size() != y.size() || x.empty())
        document_.fail(
            node, "a spline with " + std::to_string(x.size()) + " x and " + std::to_string(y.size()) + " y",
            "as many of both, one at least");
    for (std::size_t i = 0; i + 1 < x.size(); ++i)
        if (!(x[i] < x[i + 1]))
            document_.fail(node, "the x of a spline do not ascend", "each greater than the one before");
    return simm     ? JointFunction::simm_spline(x, y)
           : linear ? JointFunction::piecewise_linear(x, y)
                    : JointFunction::natural_cubic_spline(x, y);
}

CoordinateFunction OsimReader::read_function(pugi::xml_node holder, const std::vector<int>& coordinates) {
    CoordinateFunction result;
    const pugi::xml_node node = function_element(holder);
    for (const int c : coordinates)
        result.terms.push_back({c, 1.0});
    if (!node) { // as OpenSim has it: the coordinate itself, or nothing
        if (coordinates.size() > 1)
            document_.fail(holder, "several coordinates and no function", known_functions);
        result.function = coordinates.empty() ? JointFunction() : JointFunction::linear(1, 0);
        return result;
    }
    if (coordinates.size() <= 1 || std::string_view(node.name()) == "Constant") {
        result.function = read_one(node, 0);
        if (coordinates.empty() && !result.function.is_constant())
            document_.fail(node, "a function of no coordinate", "a Constant, or the name of a coordinate");
        return result;
    }
    if (std::string_view(node.name()) != "LinearFunction")
        document_.fail(node, "a " + std::string(node.name()) + " of several coordinates", "a LinearFunction");
    const std::vector<double> c = document_.numbers(node, "coefficients", coordinates.size() + 1);
    for (std::size_t i = 0; i < coordinates.size() && !c.empty(); ++i)
        result.terms[i].weight = c[i];
    result.function = JointFunction::linear(1, c.empty() ? 0.0 : c.back());
    return result;
}

} // namespace fascicle::io
