#include "bench/machine.hpp"

#include "fascicle/base/build_info.hpp"
#include "fascicle/base/parallel.hpp"

#include <cstdlib>
#include <fstream>

namespace fascicle::bench {

namespace {

std::string first_line(const std::string& path) {
    std::ifstream file(path);
    std::string line;
    std::getline(file, line);
    return line;
}

std::string cpu_name() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("model name")) {
            const std::size_t colon = line.find(": ");
            if (colon != std::string::npos)
                return line.substr(colon + 2);
        }
    return "unknown";
}

/// "2048K" or "32M" in bytes.
std::size_t size_bytes(const std::string& text) {
    const std::size_t number = std::strtoul(text.c_str(), nullptr, 10);
    if (text.ends_with('K'))
        return number << 10;
    return text.ends_with('M') ? number << 20 : number;
}

void read_caches(Machine& machine) {
    for (int i = 0; i < 8; ++i) {
        const std::string folder = "/sys/devices/system/cpu/cpu0/cache/index" + std::to_string(i) + "/";
        if (first_line(folder + "type") == "Instruction")
            continue;
        const std::string level = first_line(folder + "level");
        const std::size_t bytes = size_bytes(first_line(folder + "size"));
        if (level == "1")
            machine.l1_bytes = bytes;
        if (level == "2")
            machine.l2_bytes = bytes;
        if (level == "3")
            machine.l3_bytes = bytes;
    }
}

std::string widest_instructions() {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512f"))
        return "avx512";
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        return "avx2+fma";
#endif
    return "portable";
}

} // namespace

Machine this_machine() {
    Machine machine;
    machine.cpu = cpu_name();
    machine.cores = hardware_threads();
    machine.instructions = widest_instructions();
    read_caches(machine);
    double load = 0;
    if (getloadavg(&load, 1) == 1)
        machine.load = load;
    machine.compiler = compiler_name();
    machine.flags = FASCICLE_BUILD_FLAGS;
    machine.build = build_type();
    machine.version = program_version();
    return machine;
}

} // namespace fascicle::bench
