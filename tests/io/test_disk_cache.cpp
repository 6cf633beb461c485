#include "fascicle/io/disk_cache.hpp"
#include "fascicle/io/files.hpp"
#include "support/temp_dir.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <cstdlib>
#include <sys/wait.h>
#include <thread>

using namespace fascicle;
namespace fs = std::filesystem;

namespace {

std::string key_of(int i) {
    std::string key = "0123456789abcdef0123456789abcdef";
    for (std::size_t k = 0; k < 8; ++k)
        key[k] = "0123456789abcdef"[(i >> (4 * k)) & 15];
    return key;
}

std::string content_of(int i, std::size_t size = 20000) {
    std::string bytes(size, '\0');
    for (std::size_t k = 0; k < size; ++k)
        bytes[k] = static_cast<char>(static_cast<std::size_t>(i) * 31 + k * k % 251);
    return bytes;
}

int file_count(const fs::path& folder) {
    return static_cast<int>(std::distance(fs::directory_iterator(folder), {}));
}

/// One variable of the environment, put back afterwards.
class Variable {
public:
    Variable(const char* name, const char* value) : name_(name) {
        if (const char* old = std::getenv(name))
            old_ = old;
        value != nullptr ? ::setenv(name, value, 1) : ::unsetenv(name);
    }
    ~Variable() { old_ ? ::setenv(name_, old_->c_str(), 1) : ::unsetenv(name_); }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;

private:
    const char* name_;
    std::optional<std::string> old_;
};

} // namespace

TEST_CASE("what is kept is found again, by the next cache too", "[io][disk_cache]") {
    const test::TempDir dir;
    DiskCache cache(dir.path() / "made" / "when needed");
    CHECK_FALSE(cache.find(key_of(1)));
    CHECK_FALSE(fs::exists(dir.path() / "made")); // looking makes nothing
    cache.keep(key_of(1), content_of(1));
    cache.keep(key_of(2), "");
    CHECK(cache.find(key_of(1)) == content_of(1));
    CHECK(cache.find(key_of(2)) == "");
    CHECK_FALSE(cache.find(key_of(3)));
    DiskCache again(cache.folder());
    CHECK(again.find(key_of(1)) == content_of(1));
    again.keep(key_of(1), content_of(5));
    CHECK(cache.find(key_of(1)) == content_of(5));
    CHECK(file_count(cache.folder()) == 2); // no temporary files stay
    fs::remove_all(cache.folder());
    CHECK_FALSE(cache.find(key_of(1)));
    cache.keep(key_of(1), content_of(1));
    CHECK(cache.find(key_of(1)) == content_of(1));
}

TEST_CASE("keys that are no keys name no files", "[io][disk_cache]") {
    const test::TempDir dir;
    DiskCache cache(dir.path() / "cache");
    for (const std::string& key : {std::string(), std::string("../../escape"), std::string(32, '/'),
                                   std::string(31, 'a'), std::string(33, 'a'), std::string(32, 'G')}) {
        cache.keep(key, "bytes");
        CHECK_FALSE(cache.find(key));
    }
    CHECK_FALSE(fs::exists(dir.path() / "cache"));
}

TEST_CASE("damaged, cut off and foreign files are not found and are replaced", "[io][disk_cache]") {
    const test::TempDir dir;
    DiskCache cache(dir.path());
    const fs::path file = cache.file_of(key_of(1));
    cache.keep(key_of(1), content_of(1, 300));
    const std::string whole = read_file(file);
    const auto check_lost = [&](const std::string& bytes) {
        write_file(file, bytes);
        CHECK_FALSE(cache.find(key_of(1)));
    };
    for (std::size_t i = 0; i < whole.size(); ++i) { // every byte, header and content
        std::string damaged = whole;
        damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
        check_lost(damaged);
    }
    for (std::size_t size = 0; size < whole.size(); size += 7)
        check_lost(whole.substr(0, size));
    check_lost(whole + "x");
    check_lost("something else altogether");
    cache.keep(key_of(2), content_of(2, 300)); // sound, but of another key
    check_lost(read_file(cache.file_of(key_of(2))));
    cache.keep(key_of(1), content_of(1, 300));
    CHECK(cache.find(key_of(1)) == content_of(1, 300));

    fs::remove(file);
    fs::create_directory(file); // a folder in the way
    CHECK_FALSE(cache.find(key_of(1)));
    cache.keep(key_of(1), content_of(1, 300));
    CHECK_FALSE(cache.find(key_of(1)));
}

TEST_CASE("a cache that cannot be written is none", "[io][disk_cache]") {
    const test::TempDir dir;
    write_file(dir.path() / "file", "not a folder");
    for (const fs::path& folder :
         {dir.path() / "file", dir.path() / "file" / "below", fs::path("/proc/none")}) {
        DiskCache cache(folder);
        CHECK_NOTHROW(cache.keep(key_of(1), content_of(1)));
        CHECK_FALSE(cache.find(key_of(1)));
    }
    CHECK(read_file(dir.path() / "file") == "not a folder");
}

TEST_CASE("the oldest go first when the cache is full, and nothing but ours goes", "[io][disk_cache]") {
    const test::TempDir dir;
    DiskCache cache(dir.path(), 70000); // three of 20000 bytes
    write_file(dir.path() / "thesis.doc", std::string(100000, 't'));
    write_file(dir.path() / (key_of(9) + ".fascicle-cachet"), std::string(100000, 't'));
    const auto age = [&](int i, int hours) {
        fs::last_write_time(cache.file_of(key_of(i)),
                            fs::file_time_type::clock::now() - std::chrono::hours(hours));
    };
    for (const int i : {1, 2, 3}) {
        cache.keep(key_of(i), content_of(i));
        age(i, 10 - i);
    }
    CHECK(cache.find(key_of(1))); // 1 is now the last one used
    cache.keep(key_of(4), content_of(4));
    CHECK(cache.find(key_of(1)));
    CHECK_FALSE(cache.find(key_of(2)));
    CHECK(cache.find(key_of(3)));
    CHECK(cache.find(key_of(4)));
    CHECK(fs::exists(dir.path() / "thesis.doc"));
    cache.keep(key_of(5), content_of(5, 71000)); // larger than all that is allowed
    CHECK_FALSE(cache.find(key_of(5)));
    CHECK(cache.find(key_of(4)));

    // What a killed program left half written goes after an hour.
    const fs::path left = cache.file_of(key_of(6)).string() + ".part1-1",
                   fresh = cache.file_of(key_of(6)).string() + ".part2-1";
    write_file(left, "half");
    write_file(fresh, "half");
    fs::last_write_time(left, fs::file_time_type::clock::now() - std::chrono::hours(2));
    cache.keep(key_of(4), content_of(4));
    CHECK_FALSE(fs::exists(left));
    CHECK(fs::exists(fresh));
}

TEST_CASE("several programs share a cache and see whole things only", "[io][disk_cache]") {
    const test::TempDir dir;
    constexpr int keys = 5, rounds = 60;
    std::vector<pid_t> children;
    for (int child = 0; child < 4; ++child) {
        const pid_t pid = ::fork();
        REQUIRE(pid >= 0);
        if (pid == 0) {
            bool good = true;
            DiskCache cache(dir.path(), 70000); // full all the time: files are removed under the readers
            for (int i = 0; i < rounds; ++i) {
                const int k = (i * 7 + child) % keys;
                if (const auto found = cache.find(key_of(k)))
                    good = good && *found == content_of(k);
                else
                    cache.keep(key_of(k), content_of(k));
            }
            ::_exit(good ? 0 : 1);
        }
        children.push_back(pid);
    }
    for (const pid_t pid : children) {
        int status = -1;
        ::waitpid(pid, &status, 0);
        CHECK(WIFEXITED(status));
        CHECK(WEXITSTATUS(status) == 0);
    }
    CHECK(file_count(dir.path()) <= 4);
}

TEST_CASE("several threads share a cache", "[io][disk_cache]") {
    const test::TempDir dir;
    DiskCache cache(dir.path());
    std::atomic<int> wrong = 0;
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t)
        threads.emplace_back([&] {
            for (int i = 0; i < 40; ++i) {
                cache.keep(key_of(i % 3), content_of(i % 3));
                if (cache.find(key_of(i % 3)) != content_of(i % 3))
                    ++wrong;
            }
        });
    for (std::thread& t : threads)
        t.join();
    CHECK(wrong == 0);
}

TEST_CASE("where the cache is", "[io][disk_cache]") {
    const Variable home("HOME", "/home/somebody");
    {
        const Variable own("FASCICLE_CACHE", "/own/place"), xdg("XDG_CACHE_HOME", "/xdg");
        CHECK(cache_folder() == "/own/place");
        CHECK(open_cache() != nullptr);
    }
    {
        const Variable own("FASCICLE_CACHE", ""), xdg("XDG_CACHE_HOME", "/xdg");
        CHECK(cache_folder().empty());
        CHECK(open_cache() == nullptr);
    }
    const Variable own("FASCICLE_CACHE", nullptr);
    {
        const Variable xdg("XDG_CACHE_HOME", "/xdg");
        CHECK(cache_folder() == "/xdg/fascicle");
    }
    {
        const Variable xdg("XDG_CACHE_HOME", "relative"); // to be ignored
        CHECK(cache_folder() == "/home/somebody/.cache/fascicle");
    }
    const Variable xdg("XDG_CACHE_HOME", nullptr);
    CHECK(cache_folder() == "/home/somebody/.cache/fascicle");
    const Variable no_home("HOME", nullptr);
    CHECK(cache_folder().empty());
}
