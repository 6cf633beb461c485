// Runs files of the corpus through their targets, in any build: fascicle_fuzz_replay CORPUS [TARGET [FILE...]]. A finding ends
// it with its message, after the name of the file.

#include "fascicle/io/files.hpp"
#include "fuzz/target.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>

namespace fs = std::filesystem;
using namespace fascicle::fuzz;

namespace {

std::vector<fs::path> files_in(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
        files.push_back(it->path());
    std::sort(files.begin(), files.end());
    return files;
}

/// Number of files.
std::size_t replay(const Target& target, const std::vector<fs::path>& files) {
    const auto start = std::chrono::steady_clock::now();
    target.run({}); // tables that are made once, and kept, are no memory of a file
    double most = 0;
    for (const fs::path& file : files) {
        const std::string bytes = fascicle::read_file(file);
        std::fprintf(stderr, "\r%s \r", file.c_str()); // stays when the target aborts
        const std::size_t used = run_guarded(target, bytes);
        most = std::max(most, static_cast<double>(used) /
                                  static_cast<double>(std::max<std::size_t>(64, bytes.size())));
    }
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    std::printf("%-18s %4zu files  %6.2f s  memory %6.1f times the file\n", target.name.c_str(), files.size(),
                seconds.count(), most);
    return files.size();
}

} // namespace

int main(int argc, char** argv) {
    if (argc < 2) {
        std::fprintf(stderr, "fascicle_fuzz_replay CORPUS [TARGET [FILE...]]\n");
        return 2;
    }
    try {
        std::size_t files = 0;
        for (const Target& target : targets()) {
            if (argc > 2 && target.name != argv[2])
                continue;
            std::vector<fs::path> inputs(argv + std::min(argc, 3), argv + argc);
            files += replay(target, inputs.empty() ? files_in(fs::path(argv[1]) / target.seeds) : inputs);
        }
        std::printf("%zu files\n", files);
        return files > 0 ? 0 : 1; // no file: a corpus that is not there, or no such target
    } catch (const std::exception& error) {
        std::fprintf(stderr, "\nfascicle_fuzz_replay: %s\n", error.what());
        return 1;
    }
}
