#include "bench/variants.hpp"

#include "fascicle/solver/parameters.hpp"

#include <algorithm>

namespace fascicle::bench {

const std::vector<std::string>& variant_names() {
    static const std::vector<std::string> names{"classic", "reference", "sweeps", "fast", "bullet"};
    return names;
}

bool has_kernel(const ParamTable& table, const std::string& kernel) {
    const ParamRow* row = table.find("solver.kernel");
    return row != nullptr &&
           std::find(row->choices.begin(), row->choices.end(), kernel) != row->choices.end();
}

std::vector<Variant> make_variants(const ParamTable& table, const std::vector<int>& threads) {
    std::vector<Variant> variants{{"classic", "classic", "", 3, 1}};
    const std::string reference = has_kernel(table, "reference") ? "reference" : "";
    for (const int passes : {3, 10})
        variants.push_back({"reference", "xpbd", reference, passes, 1});
    if (has_kernel(table, "fast"))
        for (const bool coarse : {false, true})
            for (const int passes : {3, 10})
                for (const int count : threads)
                    variants.push_back({coarse ? "fast" : "sweeps", "xpbd", "fast", passes, count, coarse});
    variants.push_back({"bullet", "", "", 3, 1});
    return variants;
}

void apply(const Variant& variant, ParamSet& parameters) {
    if (variant.method.empty())
        return;
    set_method(parameters, variant.method);
    if (!variant.kernel.empty())
        parameters.set_text("solver.kernel", variant.kernel);
    parameters.set("solver.iterations", variant.passes);
    if (!variant.coarse)
        parameters.set("solver.coarse", 0);
}

} // namespace fascicle::bench
