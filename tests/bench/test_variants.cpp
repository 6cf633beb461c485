#include "bench/variants.hpp"
#include "fascicle/solver/parameters.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

using namespace fascicle;
using namespace fascicle::bench;

namespace {

ParamTable table_with_kernels(const std::vector<std::string>& kernels) {
    ParamRow row;
    row.key = "solver.kernel";
    row.kind = ParamKind::choice;
    row.choices = kernels;
    return ParamTable({row});
}

std::vector<std::string> names(const std::vector<Variant>& variants) {
    std::vector<std::string> result;
    for (const Variant& v : variants)
        result.push_back(v.name + " " + std::to_string(v.passes) + "/" + std::to_string(v.threads));
    return result;
}

} // namespace

TEST_CASE("rows of the fast kernel appear with its parameter and not before", "[bench][variants]") {
    const std::vector<std::string> plain{"classic 3/1", "reference 3/1", "reference 10/1", "bullet 3/1"};
    CHECK(names(make_variants(ParamTable({}), {1, 2})) == plain);
    CHECK(names(make_variants(table_with_kernels({"reference"}), {1, 2})) == plain);
    const auto all = make_variants(table_with_kernels({"fast", "reference"}), {1, 2});
    CHECK(names(all) == std::vector<std::string>{"classic 3/1", "reference 3/1", "reference 10/1",
                                                 "sweeps 3/1", "sweeps 3/2", "sweeps 10/1", "sweeps 10/2",
                                                 "fast 3/1", "fast 3/2", "fast 10/1", "fast 10/2",
                                                 "bullet 3/1"});
    CHECK(all[1].kernel == "reference");
    CHECK(all[3].kernel == "fast");
    for (const Variant& v : all)
        CHECK(std::count(variant_names().begin(), variant_names().end(), v.name) == 1);
}

TEST_CASE("a variant sets method, kernel and passes of this program", "[bench][variants]") {
    for (const Variant& variant : make_variants(parameter_table(), {1, 2})) {
        ParamSet parameters = default_parameters();
        apply(variant, parameters);
        if (variant.method.empty()) {
            CHECK(parameters == default_parameters());
            continue;
        }
        CHECK(parameters.get_choice("solver.method") == variant.method);
        CHECK(passes_per_frame(parameters) == variant.passes);
        if (!variant.kernel.empty())
            CHECK(parameters.get_choice("solver.kernel") == variant.kernel);
        CHECK((parameters.get_int("solver.coarse") == 0) == (variant.name == "sweeps"));
    }
}
